// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How large a picture may be so that a frame takes no longer than it should.

#ifndef limpid_FrameBudget_h
#define limpid_FrameBudget_h

namespace limpid
{
/// Predicts the time of a picture from what its rays took in the pictures before.
class FrameBudget
{
public:
  /**
   * Edge length of the picture's pixels, in pixels of the view, with which a picture of `pixels`
   * pixels of the view is expected to take no longer than `seconds`. At least 1, at most 8. It
   * changes only when it has to, so that a moving picture does not flicker.
   */
  double PixelSize(double pixels, double seconds);

  /// What a picture of so many rays is expected to take [s].
  double SecondsOf(double rays) const { return rays * this->SecondsPerRay; }

  /// What a picture of `rays` rays took.
  void Record(double rays, double seconds);

private:
  // Before anything was measured: a cautious guess for two cores [s].
  double SecondsPerRay = 3e-6;
  bool Measured = false;
  double LastPixelSize = 1;
};
}

#endif
