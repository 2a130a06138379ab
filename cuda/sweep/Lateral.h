// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_Lateral_h
#define limpid_sweep_Lateral_h

#include "math/Range.h"
#include "sweep/RayAxis.h"

#include <vector>

namespace limpid
{
/// How rays are distributed along an axis.
enum class RayPlacement
{
  ForIntegrals, ///< at the centres of parts of the box that end at the outlines of its faces
  ForNodes      ///< at nodes if rays run along them; else at the centres of equal parts
};

/**
 * The rays of a frustum along one of its lateral axes.
 *
 * A ray has the coordinate a: its slope (point eye) or its position at depth 0 (parallel eye). At
 * depth D it is at eye + a D or at a + shear D.
 */
class Lateral
{
public:
  bool parallel = false;
  double eye = 0;   ///< position of a point eye [index]
  double shear = 0; ///< lateral step of parallel rays per slice [index]
  int nodes = 0;    ///< voxels along the axis

  int count = 0; ///< number of rays, including one guard on either side for interpolation

  /// Returns the rays with the coordinates of this object, or with a copy of them on a device.
  RayAxis Axis() const { return this->Axis(this->Middles.data()); }
  RayAxis Axis(const double* coordinates) const
  {
    return { coordinates, this->parallel, this->eye, this->shear,
      { this->Edge(1), this->Edge(this->count - 1) }, this->nodes, this->count };
  }

  double Coordinate(int ray) const { return this->Middles[std::size_t(ray)]; }
  const std::vector<double>& Coordinates() const { return this->Middles; }
  double Slope(int ray) const { return this->parallel ? this->shear : this->Coordinate(ray); }

  /// Returns the coordinate half way between ray `ray` and the previous one, where the part of the
  /// box of ray `ray` begins. The spacing is extrapolated beyond the first and the last ray.
  double Edge(int ray) const;

  /// Width of the part of the box that a ray represents; 0 for guard rays.
  double Width(int ray) const
  {
    return ray > 0 && ray + 1 < this->count ? this->Edge(ray + 1) - this->Edge(ray) : 0.0;
  }

  /// Chooses the rays that see the box between two depths; none if no ray reaches it. `length`:
  /// extent of the box along the axis that has most rays or layers [index].
  void Fit(
    double nearDepth, double farDepth, double length, double rayDensity, RayPlacement placement);

  /// Returns the rays at most `reach` nodes away from the box at `depth`, and `more` on either
  /// side.
  Range<int> RaysNear(double depth, double reach, int more) const;

  /// Computes the map from rays to voxel columns at `depth`: a value each per ray in `rays`. A ray
  /// outside the box reads its border.
  void FindRayMap(double depth, const Range<int>& rays, int* index, float* weight) const;

  /// Computes the floor of the voxel column of the rays in `rays` at `depth`, ascending. Rays
  /// outside the box give up to three voxels beyond its border.
  void FindRayNodes(double depth, const Range<int>& rays, int* floors) const;

  /// Computes the map from voxel columns to rays on the slice at `depth` > 0: `nodes` values each.
  /// Voxels beyond the outermost rays take the values of these. `firstRay`: any ray that is not
  /// behind the first voxel.
  void FindVoxelMap(double depth, int firstRay, int* index, float* weight) const;

  /// Returns the depths, relative to `base`, at which a ray enters and leaves the box along this
  /// axis.
  Range<float> StayOf(int ray, double base) const;

  /// Computes the depths, relative to `base`, at which the ray through each voxel of the slice at
  /// `depth` enters the box along this axis. `entries`: `nodes` values.
  void FindVoxelEntries(double depth, double base, float* entries) const;

  /// Voxels at `depth` whose distance from the eye is at most (`closed`) or less than (open) the
  /// depth.
  Range<int> Owned(double depth, bool closed) const;

  /// Returns the position of a ray coordinate at a depth [index].
  double Position(double coordinate, double depth) const
  {
    return this->Axis().Position(coordinate, depth);
  }

private:
  /// Places rays at the centres of the intervals between `edges`.
  void PutBetween(std::vector<double> edges);

  /// Places two or three rays at the Gauss points of an interval.
  void PutAtGaussPoints(const Range<double>& interval, int rays);

  std::vector<double> Edges; ///< borders of the parts of the rays, without guards
  std::vector<double> Middles;
};

/// Computes, for each of some sources of a map and one past the last, the first target whose first
/// source is this one or a later one.
void FindFirstTargets(const int* index, int targets, const Range<int>& sources, int* first);
}

#endif
