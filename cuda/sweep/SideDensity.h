// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How densely the rays of a point source are placed where they leave a long box through a side.

#ifndef limpid_sweep_SideDensity_h
#define limpid_sweep_SideDensity_h

#include "math/Range.h"

#include <vector>

namespace limpid
{
/// Returns the number of parts of an interval that `wanted` parts fit into, but at least `fewest`.
int PartCount(double wanted, double fewest);

/**
 * The density of rays per unit of slope. A ray of slope m that leaves the box through a side does
 * so at the depth side / m, where `side` is the distance of the side from the source. In front of
 * that depth, rays that are one voxel apart on the farthest slice are closer than a voxel, and in
 * a box that is much longer than wide nearly all rays would be of this kind. It is enough if they
 * are a part of a voxel apart where they leave the box.
 *
 * The density is the same for all slopes if the box is at most twice as long as wide.
 */
class SideDensity
{
public:
  /// `slopes`: an interval; `side`: distance of the side that rays of these slopes meet [index];
  /// `last`: width of the box [index]; `perUnit`: density of rays that do not leave through a side;
  /// `least`: smallest density.
  SideDensity(const Range<double>& slopes, double side, double last, double rayDensity,
    double perUnit, double least);

  bool IsUniform() const { return this->Uniform; }

  /// Divides the interval into at least `fewest` parts and appends their ends, in ascending order.
  void Divide(double fewest, std::vector<double>& edges) const;

private:
  double CountUpTo(double slope) const;
  double SlopeAt(double count) const;

  bool Mirrored;        ///< whether the slopes are negative
  Range<double> Slopes; ///< absolute values
  double Most;          ///< density up to the slope GradedFrom
  double Least;         ///< density from the slope GradedTo on
  double GradedFrom;    ///< between these two, the density is proportional to 1 / slope
  double GradedTo;
  bool Uniform;
};
}

#endif
