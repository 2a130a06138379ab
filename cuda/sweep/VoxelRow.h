// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Visits voxels row by row, on the processor. It interpolates the values of rays and calls the
// steps of a kernel. VoxelSampler.h does so for single voxels.

#ifndef limpid_sweep_VoxelRow_h
#define limpid_sweep_VoxelRow_h

#include "sweep/RowSampler.h"

namespace limpid
{
/// What voxels see: the mean transmittance, and the mean visible importance behind, which is
/// attenuated by it.
struct SeenByVoxels
{
  float* transmittance; ///< [0, 1]
  float* behind;        ///< [scale^2]
};

/// A row of voxels on a slice of a frustum. Arrays are indexed by voxel column.
class VoxelRow
{
public:
  using Field = SliceWindow*;
  using Rays = RaysBeside;

  /// Uses scratch memory of the calling thread.
  VoxelRow(const FaceFrustum& frustum, int s, int v);

  /// The slice that contains the row.
  const Slice& SliceHere() const { return this->Here; }

  /// The columns that may change.
  const Range<int>& Filled() const { return this->Changing; }

  /// Returns this row of a field.
  float* Row(Field field) const { return field->Row(this->Here.node, this->V); }

  /// Prefetches the next row of a field; null is allowed.
  LIMPID_INLINE void Prefetch(Field field) const
  {
    if (field)
    {
      field->Prefetch(this->Here.node, this->V + 1, this->Changing);
    }
  }

  /**
   * Computes what the active columns see, as means over their hat functions across the rays.
   * Between rays that enter through a side, it uses the transmittance at the voxel itself and
   * scales the importance behind accordingly. Returns whether any column is active.
   */
  bool FindSeen(const RaysBeside& rays);

  const SeenByVoxels& SeenHere() const { return this->Means; }

  /**
   * Sums RaysBeside::behind over the rays for each active column. The weights are those by which
   * rays interpolate voxels, divided by the part of the hat function that is inside the box and
   * covered by rays. Returns whether any column is active.
   */
  bool FindEffect(const RaysBeside& rays);

  const float* EffectHere() const { return this->Means.behind; }

  /// Returns the importance of the nodes inside the view, in the active columns.
  const float* ImportanceInView(Field nodeImportance);

  /// Calls step(column) for the active columns.
  template <class Step>
  void ForActive(const Step& step) const
  {
    detail::StepAlongRow(this->Active, step);
  }

  /// Calls step(column) for columns that may change but that no active ray reaches.
  template <class Step>
  void ForIdle(const Step& step) const
  {
    const Range<int> active =
      this->Active.Empty() ? Range<int>{ this->Changing.end, this->Changing.end } : this->Active;
    detail::StepAlongRow({ this->Changing.begin, active.begin }, step);
    detail::StepAlongRow({ active.end, this->Changing.end }, step);
  }

  /// Computes the transmittance at all columns that the frustum owns. It uses cubics between rays
  /// that have entered the box.
  void FindTransmittance(const RaysBeside& rays, float* transmittance);

private:
  /// Rows of values, with one more voxel on either side in `voxels`.
  struct Scratch
  {
    float* importance;
    float* rays[3];
    float* voxels;
  };

  /// The map from voxels to rays along the row, see LinearMap.
  LinearMap Columns() const { return this->Frustum.Row(this->Frustum.voxelColumns, this->S); }
  LinearMap Rows() const { return this->Frustum.Row(this->Frustum.voxelRows, this->S); }

  Range<int> RaysRead(const Range<int>& columns) const;
  Range<int> BetweenFrontRays(const Range<int>& columns) const;
  void SampleRays(const float* image, const Range<int>& columns, float* out);
  void SampleCubic(const float* image, const Range<int>& columns, float* out);
  void TransmitFromSide(const RaysBeside& rays, const Range<int>& columns, float* out);
  void TransmitLinear(const RaysBeside& rays, const Range<int>& columns, float* out);
  void TransmitDensity(const Range<int>& columns, float* densityToTransmittance) const;
  void AverageVoxels(const float* rays, float* out);
  Range<int> ColumnsAboutActive() const;

  const FaceFrustum& Frustum;
  const Slice& Here;
  int S;
  int V;
  Range<int> Changing;
  Range<int> Active;
  SeenByVoxels Means{};
  Scratch Memory{};
};
}

#endif
