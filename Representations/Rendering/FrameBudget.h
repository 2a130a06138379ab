// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Chooses the coarseness of a picture by the time limit of a frame.

#ifndef limpid_FrameBudget_h
#define limpid_FrameBudget_h

namespace limpid
{
/// Predicts the time of a picture from the times per ray of previous pictures.
class FrameBudget
{
public:
  /**
   * Returns the coarseness with which a picture of `pixels` pixels of the view should take at most
   * `seconds`: up to 8 the edge length of its pixels, in pixels of the view; then samples are
   * farther apart, too. It changes only if necessary, so that pictures do not flicker. `farthest`:
   * the largest distance of samples that is possible, see StepOf.
   */
  double Coarseness(double pixels, double seconds, double farthest);

  /// Returns the edge length of the pixels of a picture, in pixels of the view [1, 8].
  static double PixelSizeOf(double coarseness);

  /// Returns the distance of samples, in units of that of fine pictures, >= 1.
  static double StepOf(double coarseness);

  /// Returns the expected time of a fine picture with this number of rays [s].
  double SecondsOf(double rays) const { return rays * this->SecondsPerRay; }

  /// Sets the expected time of a ray [s], unless one was recorded.
  void Expect(double secondsPerRay);

  /// Records the time that a picture of `rays` rays took [s]. `step`: see StepOf.
  void Record(double rays, double step, double seconds);

private:
  // The initial value is a cautious estimate for two cores [s].
  double SecondsPerRay = 3e-6;
  bool Measured = false;
  double LastCoarseness = 1;
};
}

#endif
