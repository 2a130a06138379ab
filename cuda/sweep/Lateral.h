// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_Lateral_h
#define limpid_sweep_Lateral_h

#include "math/Range.h"

#include <vector>

namespace limpid
{
/// Where rays lie best.
enum class Placement
{
  ForIntegrals, ///< in the middle of parts of the box, which end where the outlines of its faces do
  ForNodes      ///< on the nodes, where rays run along them; else in the middle of equal parts
};

/**
 * The rays of a frustum along one of its lateral axes.
 *
 * A ray has the coordinate a, its slope (point eye) or its position at depth 0 (parallel eye); at
 * depth D it is at eye + a D or at a + shear D.
 */
class Lateral
{
public:
  bool parallel = false;
  double eye = 0;   ///< point eye: its position [index]
  double shear = 0; ///< parallel eye: lateral step per slice [index]
  int nodes = 0;    ///< voxels along the axis

  int count = 0; ///< rays, with one guard on either side that only serves interpolation

  double Coordinate(int ray) const { return this->Middles[std::size_t(ray)]; }
  const std::vector<double>& Coordinates() const { return this->Middles; }
  double Slope(int ray) const { return this->parallel ? this->shear : this->Coordinate(ray); }

  /// Where the part of the box that ray `ray` stands for begins: half way to the ray before. The
  /// rays -1 and `count` and one more are as far away as their neighbours are from each other.
  double Edge(int ray) const;

  /// Size of the part of the box that a ray stands for; 0 for guards.
  double Width(int ray) const
  {
    return ray > 0 && ray + 1 < this->count ? this->Edge(ray + 1) - this->Edge(ray) : 0.0;
  }

  /// Chooses the rays that see the box between two depths; none if it is out of reach.
  void Fit(double nearDepth, double farDepth, double rayDensity, Placement placement);

  /// The map from rays to voxel columns at `depth`: `count` values each. A ray outside the box
  /// reads its border.
  void FindRayMap(double depth, int* index, float* weight) const;

  /// Floor of the voxel column of every ray at `depth`, ascending; outside the box up to three
  /// voxels beside it. `floors`: `count` values.
  void FindRayNodes(double depth, int* floors) const;

  /// The map from voxel columns to rays on the slice at `depth`, a positive depth: `nodes` values
  /// each. Voxels beyond the outermost rays take the value of these.
  void FindVoxelMap(double depth, int* index, float* weight) const;

  /// Depths at which a ray enters and leaves the slab of the box, relative to `base`.
  Range<float> StayOf(int ray, double base) const;

  /// Depths, relative to `base`, at which the rays through every voxel on the slice at `depth`
  /// enter the slab. `entries`: `nodes` values.
  void FindVoxelEntries(double depth, double base, float* entries) const;

  /// Voxels at `depth` whose distance from the eye is at most (closed) or below (open) the depth.
  Range<int> Owned(double depth, bool closed) const;

  /// Where a coordinate is at a depth [index].
  double Position(double coordinate, double depth) const
  {
    return this->parallel ? coordinate + this->shear * depth : this->eye + coordinate * depth;
  }

private:
  /// Puts rays in the middle of the parts between edges.
  void PutBetween(std::vector<double> edges);

  std::vector<double> Edges; ///< of the rays but the guards
  std::vector<double> Middles;
};
}

#endif
