// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How the processor visits voxels: one row of a slice at a time. It interpolates what the rays
// carry and calls the steps of a kernel; VoxelSampler.h does so for one voxel.

#ifndef limpid_sweep_VoxelRow_h
#define limpid_sweep_VoxelRow_h

#include "sweep/RowSampler.h"

namespace limpid
{
/// What voxels see: the mean transmittance, and the mean of what it leaves of the importance
/// behind.
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

  /// Takes the calling thread's scratch memory.
  VoxelRow(const FaceFrustum& frustum, int s, int v);

  /// The slice on which the row lies.
  const Slice& SliceHere() const { return this->Here; }

  /// The columns that may change.
  const Range<int>& Filled() const { return this->Changing; }

  /// Row of a field.
  float* Row(Field field) const { return field->Row(this->Here.node, this->V); }

  /// Brings the next row of a field, if there is one.
  LIMPID_INLINE void Prefetch(Field field) const
  {
    if (field)
    {
      field->Prefetch(this->Here.node, this->V + 1, this->Changing);
    }
  }

  /**
   * Finds what the active columns see: means over their hat functions across the rays. Between rays
   * that enter through a side, transmittance is that at the voxel, and the means say what it leaves
   * of what is behind. Returns whether any column is active.
   */
  bool FindSeen(const RaysBeside& rays);

  const SeenByVoxels& SeenHere() const { return this->Means; }

  /**
   * Finds what the rays say of the active columns (RaysBeside::behind): the sum over rays with the
   * weights by which these interpolate the voxels, per part of a cell that is inside the box and
   * among the rays. Returns whether any column is active.
   */
  bool FindEffect(const RaysBeside& rays);

  const float* EffectHere() const { return this->Means.behind; }

  /// The importance of nodes as far as the picture shows them, in the active columns.
  const float* ImportanceInView(Field nodeImportance);

  /// Calls step(column) for the active columns.
  template <class Step>
  void ForActive(const Step& step) const
  {
    detail::StepAlongRow(this->Active, step);
  }

  /// Calls step(column) for columns that may change and do not see any ray that matters.
  template <class Step>
  void ForIdle(const Step& step) const
  {
    const Range<int> active =
      this->Active.Empty() ? Range<int>{ this->Changing.end, this->Changing.end } : this->Active;
    detail::StepAlongRow({ this->Changing.begin, active.begin }, step);
    detail::StepAlongRow({ active.end, this->Changing.end }, step);
  }

  /// The transmittance at all columns that the frustum owns, by cubics between the rays where these
  /// have entered the box.
  void FindTransmittance(const RaysBeside& rays, float* transmittance);

private:
  /// Rows of values; one more voxel on either side of `voxels`.
  struct Scratch
  {
    float* importance;
    float* rays[3];
    float* voxels;
  };

  /// A map from voxels to rays along the row, see LinearMap.
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
