// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Chooses the size of a picture by the time limit of a frame.

#ifndef limpid_FrameBudget_h
#define limpid_FrameBudget_h

namespace limpid
{
/// Predicts the time of a picture from the times per ray of previous pictures.
class FrameBudget
{
public:
  /**
   * Returns the edge length of the picture's pixels, in pixels of the view, in [1, 8], with which a
   * picture of `pixels` pixels of the view should take at most `seconds`. It changes only if
   * necessary, so that pictures do not flicker.
   */
  double PixelSize(double pixels, double seconds);

  /// Returns the expected time of a picture with this number of rays [s].
  double SecondsOf(double rays) const { return rays * this->SecondsPerRay; }

  /// Records the time that a picture of `rays` rays took [s].
  void Record(double rays, double seconds);

private:
  // The initial value is a cautious estimate for two cores [s].
  double SecondsPerRay = 3e-6;
  bool Measured = false;
  double LastPixelSize = 1;
};
}

#endif
