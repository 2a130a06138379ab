// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_HatOfVoxel_h
#define limpid_sweep_HatOfVoxel_h

#include "sweep/FaceFrustum.h"

namespace limpid
{
/// The rays that a mean over a voxel's hat function (HatMean) reads along one axis. There are
/// three pairs of neighbouring rays: at the previous voxel, at the voxel and at the next one.
/// Devices keep a table of these.
struct alignas(16) HatOfVoxel
{
  int first[3];  ///< first ray of each pair
  float entry;   ///< relative depth where the rays through the voxel enter the box
  float low[3];  ///< weight of the first ray of each pair
  float high[3]; ///< weight of the second ray of each pair
  float weight;  ///< interpolation weight of the second ray of the voxel's own pair

  /// `rays`: map from voxels to rays on a slice; `side`: SideWeight.
  LIMPID_HD LIMPID_INLINE static HatOfVoxel Of(
    const LinearMap& rays, float side, float entry, int voxel, int nodes)
  {
    HatOfVoxel hat;
    hat.entry = entry;
    hat.weight = rays.weight[voxel];
    for (int i = 0; i < 3; ++i)
    {
      const int beside = voxel + i - 1;
      const int at = beside < 0 ? 0 : beside < nodes ? beside : nodes - 1;
      const float share = i == 1 ? 1.0f - 2.0f * side : side;
      hat.first[i] = rays.index[at];
      hat.high[i] = share * rays.weight[at];
      hat.low[i] = share - hat.high[i];
    }
    return hat;
  }
};

/// Computes the hats of a frustum, slice by slice: first those of the columns, then of the rows.
struct MadeHat
{
  FaceFrustum frustum;
  HatOfVoxel* hats;

  static Index CountOf(const FaceFrustum& frustum)
  {
    return Index(frustum.SliceCount()) * (frustum.nodesU + frustum.nodesV);
  }

  LIMPID_HD void operator()(Index number) const
  {
    const FaceFrustum& plan = this->frustum;
    const int length = plan.nodesU + plan.nodesV;
    const auto s = static_cast<int>(number / length);
    const auto voxel = static_cast<int>(number % length);
    const int v = voxel - plan.nodesU;
    this->hats[number] = v < 0
      ? HatOfVoxel::Of(plan.Row(plan.voxelColumns, s), plan.Row(plan.columnSides, s)[voxel],
          plan.Row(plan.voxelColumnEntry, s)[voxel], voxel, plan.nodesU)
      : HatOfVoxel::Of(plan.Row(plan.voxelRows, s), plan.Row(plan.rowSides, s)[v],
          plan.Row(plan.voxelRowEntry, s)[v], v, plan.nodesV);
  }
};
}

#endif
