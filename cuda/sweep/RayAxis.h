// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The formulas of a plan along one lateral axis, for the processor and for devices.

#ifndef limpid_sweep_RayAxis_h
#define limpid_sweep_RayAxis_h

#include "math/Range.h"
#include "math/Vec.h"
#include "sweep/FaceFrustum.h"
#include "sweep/HatMean.h"

namespace limpid
{
/// Positions along an axis at a depth [index].
struct DepthLine
{
  double offset;
  double factor;

  LIMPID_HD LIMPID_INLINE double At(double coordinate) const
  {
    return this->offset + coordinate * this->factor;
  }
};

/// The rays of a frustum along one lateral axis; see Lateral, which places them.
struct RayAxis
{
  const double* coordinates; ///< one per ray, ascending
  bool parallel;
  double eye;      ///< position of a point eye [index]
  double shear;    ///< lateral step of parallel rays per slice [index]
  double edges[2]; ///< coordinates where the parts of the rays begin and end, without guards
  int nodes;       ///< voxels along the axis
  int count;       ///< number of rays

  LIMPID_HD LIMPID_INLINE DepthLine LineAt(double depth) const
  {
    return this->parallel ? DepthLine{ this->shear * depth, 1.0 } : DepthLine{ this->eye, depth };
  }

  /// Returns the position of a ray coordinate at a depth [index].
  LIMPID_HD LIMPID_INLINE double Position(double coordinate, double depth) const
  {
    return this->parallel ? coordinate + this->shear * depth : this->eye + coordinate * depth;
  }

  LIMPID_HD LIMPID_INLINE double Slope(int ray) const
  {
    return this->parallel ? this->shear : this->coordinates[ray];
  }

  /// Returns the coordinate of the ray through a voxel at a depth.
  LIMPID_HD LIMPID_INLINE double CoordinateThrough(int voxel, double depth) const
  {
    return CoordinateThrough(voxel, this->LineAt(depth), this->parallel);
  }

  LIMPID_HD LIMPID_INLINE static double CoordinateThrough(
    int voxel, const DepthLine& line, bool isParallel)
  {
    const double distance = voxel - line.offset;
    return isParallel ? distance : distance / line.factor;
  }

  /// Returns the nodes that a ray is interpolated from at a depth. A ray outside the box reads its
  /// border.
  LIMPID_HD LIMPID_INLINE NodePair NodesOf(int ray, double depth) const
  {
    return NodesAt(this->LineAt(depth).At(this->coordinates[ray]), this->nodes);
  }

  /// Returns the floor of a ray's position at a depth. Rays outside the box give up to three voxels
  /// beyond its border.
  LIMPID_HD LIMPID_INLINE int FloorOf(int ray, double depth) const
  {
    return FloorNear(this->LineAt(depth).At(this->coordinates[ray]), this->nodes);
  }

  LIMPID_HD LIMPID_INLINE static int FloorNear(double position, int nodes)
  {
    const double least = -3.0;
    const double most = nodes + 2.0;
    const double notBefore = position < least ? least : position;
    const double near = most < notBefore ? most : notBefore;
    const int towardsZero = static_cast<int>(near);
    return towardsZero - (near < towardsZero ? 1 : 0);
  }

  /// Returns the weight of the second of two coordinates for interpolation at one between them.
  /// Beyond them it is that of the nearest [0, 1].
  LIMPID_HD LIMPID_INLINE static float WeightBetween(double before, double behind, double wanted)
  {
    const double share = (wanted - before) / (behind - before);
    const double positive = share < 0.0 ? 0.0 : share;
    return static_cast<float>(1.0 < positive ? 1.0 : positive);
  }

  /// Returns the relative depths at which a ray of a coordinate enters and leaves the box along
  /// this axis. `base`: depth of the first slice.
  LIMPID_HD LIMPID_INLINE Range<float> StayAt(double coordinate, double base) const
  {
    return Clip(this->parallel ? coordinate : this->eye, this->parallel ? this->shear : coordinate,
      this->nodes - 1, base);
  }

  /// Returns the depths, minus `base`, at which the line start + slope * depth is in [0, last].
  LIMPID_HD LIMPID_INLINE static Range<float> Clip(
    double start, double slope, double last, double base)
  {
    const double never = 1e30;
    const bool crosses = slope != 0;
    const bool beside = (start < 0) | (start > last);
    const double atZero = (0 - start) / slope;
    const double atLast = (last - start) / slope;
    const double nearer = atLast < atZero ? atLast : atZero;
    const double farther = atZero < atLast ? atLast : atZero;
    const double low = crosses ? nearer - base : (beside ? never : -never);
    const double high = crosses ? farther - base : (beside ? -never : never);
    const double entry = low < -never ? -never : low;
    const double exit = high < -never ? -never : high;
    return { static_cast<float>(never < entry ? never : entry),
      static_cast<float>(never < exit ? never : exit) };
  }

  /// Returns SideWeight of a voxel on the slice at a depth. `rays`: map from the slice's voxels to
  /// rays.
  LIMPID_HD LIMPID_INLINE float SideOf(const LinearMap& rays, int voxel, double depth) const
  {
    if (voxel == 0 || voxel == this->nodes - 1)
    {
      return this->nodes > 1 ? sideWeightOnBorder : 0.0f;
    }
    const double nodesApart = this->parallel ? 1.0 : depth;
    const int ray = rays.index[voxel];
    const double gap = nodesApart * (this->coordinates[ray + 1] - this->coordinates[ray]);
    return SideWeight(rays.weight[voxel], static_cast<float>(gap));
  }

  /// Returns the positions between which rays cover the slice at a depth.
  LIMPID_HD LIMPID_INLINE Range<double> CoveredAt(double depth) const
  {
    return { this->Position(this->edges[0], depth), this->Position(this->edges[1], depth) };
  }

  /// Returns the gain of a voxel on a slice, see FaceFrustum::columnHatGain. `covered`: see
  /// CoveredAt; `about(voxel)`: rays around it; `shares`: widths of the rays.
  template <class About>
  LIMPID_HD LIMPID_INLINE float HatGainOf(int voxel, const Slice& slice,
    const Range<double>& covered, const About& about, const RayLine* lines,
    const float* shares) const
  {
    constexpr double rounding = 1e-3;
    const double last = this->nodes - 1;
    const double begin = voxel > 1 ? voxel - 1.0 : 0.0;
    const double end = voxel + 1.0 < last ? voxel + 1.0 : last;
    // The part of the hat function that is inside the box.
    double share = voxel == 0 || voxel == this->nodes - 1 ? 0.5 : 1.0;
    if (!(begin > covered.begin - rounding && end < covered.end + rounding))
    {
      const Range<int> rays = about(voxel);
      double sum = 0;
      for (int ray = rays.begin; ray < rays.end; ++ray)
      {
        sum +=
          double(shares[ray]) * HatAt(lines[ray].At(slice.RelativeDepth()), voxel, this->nodes);
      }
      share = sum * slice.scale;
    }
    return share > rounding ? static_cast<float>(1 / share) : 0.0f;
  }
};
}

#endif
