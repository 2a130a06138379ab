// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A frustum as the rays and voxels of a device read it: numbers and addresses, nothing else.

#ifndef limpid_sweep_PyramidView_h
#define limpid_sweep_PyramidView_h

#include "math/Range.h"
#include "math/Vec.h"
#include "sweep/HatMean.h"
#include "sweep/RayLayer.h"

namespace limpid
{
/// A slice and the layer behind it, see Slice.
struct SliceView
{
  int node;
  float scale;
  Layer layer; ///< its front is the slice's relative depth
  int nodes[2];
  float fractions[2]; ///< of the planes at the two Gauss points
  Range<int> ownedColumns;
  Range<int> ownedRows;
};

/// Linear interpolation at the targets of one row of a table: LinearMap, one after another.
struct MapView
{
  const int* index;
  const float* weight;
};

/// See FaceFrustum. Tables have one row per slice, planes two.
struct FrustumView
{
  int nodesU;
  int nodesV;
  Index strideU; ///< of the fields along u, v, w
  Index strideV;
  Index strideW;
  int columns;
  int rows;
  int lastSlice;
  int firstNodeSlice;
  float frontDepth;
  Range<int> frontColumns;
  Range<int> frontRows;

  const SliceView* slices;
  MapView planeColumns;          ///< [2 slice + half][columns]
  MapView planeRows;             ///< [2 slice + half][rows]
  MapView voxelColumns;          ///< [slice][nodesU]
  MapView voxelRows;             ///< [slice][nodesV]
  const float* voxelColumnSides; ///< [slice][nodesU]: SideWeight
  const float* voxelRowSides;    ///< [slice][nodesV]
  const float* voxelColumnEntry; ///< [slice][nodesU]
  const float* voxelRowEntry;    ///< [slice][nodesV]
  const Range<int>* work;        ///< [slice][rows]: columns of rays
  const Range<int>* voxelWork;   ///< [slice][nodesV]: voxel columns whose rays matter
  const Range<int>* voxelFilled; ///< [slice][nodesV]: voxel columns that may change
  const Range<float>* columnClips;
  const Range<float>* rowClips;
  const float* length;  ///< per ray: world length per unit of depth
  const double* shares; ///< per ray: what it stands for in an integral over the domain, SumOfRays
  const float* inView;  ///< per ray; null: all are

  LIMPID_HD LIMPID_INLINE Index RayAt(int column, int row) const
  {
    return Index(row) * this->columns + column;
  }

  /// Whether a ray has to be visited in the layer behind slice `s`.
  LIMPID_HD LIMPID_INLINE bool Works(int s, int column, int row) const
  {
    const Range<int>& span = this->work[Index(s) * this->rows + row];
    return column >= span.begin && column < span.end;
  }

  /// Relative depth where a ray begins: where it enters the box, or at the front.
  LIMPID_HD LIMPID_INLINE float EntryOfRay(int column, int row) const
  {
    return this->Entry(this->columnClips[column].begin, this->rowClips[row].begin);
  }

  /// The same of the ray through a voxel of slice `s`.
  LIMPID_HD LIMPID_INLINE float EntryOfVoxel(int s, int u, int v) const
  {
    return this->Entry(this->voxelColumnEntry[Index(s) * this->nodesU + u],
      this->voxelRowEntry[Index(s) * this->nodesV + v]);
  }

  /// How much of a voxel of slice `s` the picture shows [0, 1].
  LIMPID_HD LIMPID_INLINE float VoxelSeen(int s, int u, int v) const
  {
    return this->inView ? this->SampleRays(this->inView, s, u, v) : 1.0f;
  }

  LIMPID_HD LIMPID_INLINE Index VoxelAt(int slice, int u, int v) const
  {
    return this->strideW * slice + this->strideV * v + this->strideU * u;
  }

  /// A field where a ray meets the plane at Gauss point `half` of the layer behind slice `s`.
  LIMPID_HD LIMPID_INLINE float SamplePlane(
    const float* field, int s, int half, int column, int row) const
  {
    const SliceView& slice = this->slices[s];
    const Corner corner = this->CornerOf(s, half, column, row);
    const float* front = field + this->strideW * slice.nodes[0] + corner.offset;
    const float* back = field + this->strideW * slice.nodes[1] + corner.offset;
    const float along = slice.fractions[half];
    const auto column0 = [&](const float* f, const float* b)
    {
      const float first = f[0] + along * (b[0] - f[0]);
      const float second = f[this->strideV] + along * (b[this->strideV] - f[this->strideV]);
      return first + corner.across * (second - first);
    };
    const float left = column0(front, back);
    const float right = column0(front + this->strideU, back + this->strideU);
    return left + corner.sideways * (right - left);
  }

  /// The same on the slice behind the layer.
  LIMPID_HD LIMPID_INLINE float SampleRear(
    const float* field, int s, int half, int column, int row) const
  {
    const Corner corner = this->CornerOf(s, half, column, row);
    const float* back = field + this->strideW * this->slices[s].nodes[1] + corner.offset;
    const float left = back[0] + corner.across * (back[this->strideV] - back[0]);
    const float* other = back + this->strideU;
    const float right = other[0] + corner.across * (other[this->strideV] - other[0]);
    return left + corner.sideways * (right - left);
  }

  /// An image of the rays at a voxel of slice `s`.
  LIMPID_HD LIMPID_INLINE float SampleRays(const float* image, int s, int u, int v) const
  {
    const Index column = Index(s) * this->nodesU + u;
    const Index row = Index(s) * this->nodesV + v;
    const float* first =
      image + this->RayAt(this->voxelColumns.index[column], this->voxelRows.index[row]);
    const float* second = first + this->columns;
    const float across = this->voxelRows.weight[row];
    const float left = first[0] + across * (second[0] - first[0]);
    const float right = first[1] + across * (second[1] - first[1]);
    return left + this->voxelColumns.weight[column] * (right - left);
  }

  /// The mean of an image of the rays over the hat function of a voxel, across the rays.
  LIMPID_HD LIMPID_INLINE float AverageRays(const float* image, int s, int u, int v) const
  {
    const float side = this->voxelRowSides[Index(s) * this->nodesV + v];
    const float own = this->AverageAlongRow(image, s, u, v);
    if (side == 0)
    {
      return own;
    }
    const float before = v > 0 ? this->AverageAlongRow(image, s, u, v - 1) : own;
    const float behind = v + 1 < this->nodesV ? this->AverageAlongRow(image, s, u, v + 1) : own;
    return HatMean(before, own, behind, side);
  }

  LIMPID_HD LIMPID_INLINE float Seen(int column, int row) const
  {
    return this->inView ? this->inView[this->RayAt(column, row)] : 1.0f;
  }

private:
  LIMPID_HD LIMPID_INLINE float AverageAlongRow(const float* image, int s, int u, int v) const
  {
    const float side = this->voxelColumnSides[Index(s) * this->nodesU + u];
    const float own = this->SampleRays(image, s, u, v);
    if (side == 0)
    {
      return own;
    }
    const float before = u > 0 ? this->SampleRays(image, s, u - 1, v) : own;
    const float behind = u + 1 < this->nodesU ? this->SampleRays(image, s, u + 1, v) : own;
    return HatMean(before, own, behind, side);
  }

  LIMPID_HD LIMPID_INLINE float Entry(float inColumn, float inRow) const
  {
    const float behindFront = inRow > this->frontDepth ? inRow : this->frontDepth;
    return behindFront > inColumn ? behindFront : inColumn;
  }

  struct Corner
  {
    Index offset;   ///< of the first of four nodes in a slice
    float sideways; ///< weight of the second one along u
    float across;   ///< ... along v
  };

  LIMPID_HD LIMPID_INLINE Corner CornerOf(int s, int half, int column, int row) const
  {
    const Index plane = 2 * Index(s) + half;
    const Index atColumn = plane * this->columns + column;
    const Index atRow = plane * this->rows + row;
    return { this->strideU * this->planeColumns.index[atColumn] +
        this->strideV * this->planeRows.index[atRow],
      this->planeColumns.weight[atColumn], this->planeRows.weight[atRow] };
  }
};

/// Means of transmittance, and of what it leaves of the importance behind, [0, 1] and [scale^2].
struct SeenAtVoxel
{
  float transmittance;
  float behind;
};

/// What an entry ahead or behind makes of the transmittance between rays, see SampleTransmittance.
struct TransmittanceImages
{
  const float* transmittance;
  const float* density;

  /// Transmittance at a voxel of slice `s` [0, 1].
  LIMPID_HD LIMPID_INLINE float operator()(const FrustumView& rays, int s, int u, int v) const
  {
    return IsBetweenFrontRays(rays, s, u, v) ? rays.SampleRays(this->transmittance, s, u, v)
                                             : this->FromSide(rays, s, u, v);
  }

  /// What voxels of slice `s` see, see AverageSeen. `seenBehind`: of the rays.
  LIMPID_HD LIMPID_INLINE SeenAtVoxel Average(
    const FrustumView& rays, const float* seenBehind, int s, int u, int v) const
  {
    const SeenAtVoxel mean{ rays.AverageRays(this->transmittance, s, u, v),
      rays.AverageRays(seenBehind, s, u, v) };
    if (IsBetweenFrontRays(rays, s, u, v))
    {
      return mean;
    }
    const float here = this->FromSide(rays, s, u, v);
    return { here, Exchanged(mean.behind, mean.transmittance, here) };
  }

private:
  LIMPID_HD static LIMPID_INLINE bool IsBetweenFrontRays(
    const FrustumView& rays, int s, int u, int v)
  {
    const int column = rays.voxelColumns.index[Index(s) * rays.nodesU + u];
    const int row = rays.voxelRows.index[Index(s) * rays.nodesV + v];
    return column >= rays.frontColumns.begin && column + 1 < rays.frontColumns.end &&
      row >= rays.frontRows.begin && row + 1 < rays.frontRows.end;
  }

  LIMPID_HD LIMPID_INLINE float FromSide(const FrustumView& rays, int s, int u, int v) const
  {
    return Transmitted(rays.SampleRays(this->density, s, u, v) *
      (rays.slices[s].layer.front - rays.EntryOfVoxel(s, u, v)));
  }
};
}

#endif
