// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The policy sweep of one frustum on a device: PolicySweep.cxx, ray by ray and voxel by voxel.

#ifndef limpid_optimize_PolicyPhases_h
#define limpid_optimize_PolicyPhases_h

#include "energy/TermKernels.h"
#include "optimize/PolicyVoxel.h"

namespace limpid
{
/**
 * Back to front, two phases per slice: first all rays move to it through the voxels behind, which
 * are final, then its own voxels are found. In a last phase the rays leave the volume. See
 * PolicyFields for the arrays.
 */
struct PolicyPhases
{
  FrustumView rays;
  RayStates states;
  PolicyVoxel<float> policy;
  bool trust;  ///< whether the transmittance of the last iterate is believed in
  bool widens; ///< whether rays carry the weight of Deviation D1
  const float* base;
  const float* importance;
  const float* nodeImportance;
  const float* extinction;
  const float* lagged; ///< null: none
  float* next;
  RayTotals totals; ///< out

  int PhaseCount() const { return 2 * (this->rays.lastSlice + 1 - this->rays.firstNodeSlice) + 1; }

  LIMPID_HD LIMPID_INLINE Extent ExtentOf(int phase) const
  {
    if (IsOfRays(phase))
    {
      return { this->rays.columns, this->rays.rows };
    }
    const SliceView& slice = this->rays.slices[this->SliceOf(phase)];
    return { slice.ownedColumns.end - slice.ownedColumns.begin,
      slice.ownedRows.end - slice.ownedRows.begin };
  }

  LIMPID_HD LIMPID_INLINE void operator()(int phase, int column, int row) const
  {
    const int s = this->SliceOf(phase);
    if (s < this->rays.firstNodeSlice)
    {
      this->Leave(column, row);
      return;
    }
    if (IsOfRays(phase))
    {
      this->MoveRay(s, column, row);
      return;
    }
    const SliceView& slice = this->rays.slices[s];
    this->FindVoxel(s, slice.ownedColumns.begin + column, slice.ownedRows.begin + row);
  }

private:
  LIMPID_HD static LIMPID_INLINE bool IsOfRays(int phase) { return phase % 2 == 0; }

  LIMPID_HD LIMPID_INLINE int SliceOf(int phase) const { return this->rays.lastSlice - phase / 2; }

  LIMPID_HD LIMPID_INLINE LayerOfRay LayerAt(int s, int i, int j) const
  {
    LayerOfRay layer(this->rays, s, i, j);
    if (!this->widens)
    {
      layer.layer.frontScale = layer.layer.backScale = 1;
    }
    return layer;
  }

  LIMPID_HD LIMPID_INLINE void MoveRay(int s, int i, int j) const
  {
    const Index ray = this->rays.RayAt(i, j);
    const int last = this->rays.lastSlice;
    if (s + 1 < last && this->rays.Works(s + 1, i, j))
    {
      RayBehind state(this->states, ray);
      this->Carry(s + 1, i, j, state);
      state.Store(this->states, ray);
    }
    if (!this->rays.Works(s, i, j))
    {
      return;
    }
    LayerOfRay layer = this->LayerAt(s, i, j);
    if (s < last)
    {
      // The rear half is taken to be as opaque as the slice behind it, as the slice in front is not
      // known yet.
      layer.extinction[1] = this->rays.SampleRear(this->next, s, 1, i, j);
      layer.importance[1] =
        this->rays.Seen(i, j) * this->rays.SamplePlane(this->importance, s, 1, i, j);
      this->states.ahead[ray] = Carried(layer.Half<Cut::Exit>(1), this->states.behind[ray]);
    }
    if (!this->trust)
    {
      return;
    }
    double depth = this->states.opticalDepth[ray];
    layer.extinction[0] = layer.extinction[1] = 0;
    if (s < last)
    {
      layer.extinction[0] = this->rays.SamplePlane(this->extinction, s, 0, i, j);
      layer.extinction[1] = this->rays.SamplePlane(this->extinction, s, 1, i, j);
      depth -= layer.WholeDepth();
      this->states.opticalDepth[ray] = depth;
    }
    TransmitRay(this->rays, s, i, j, depth, layer.extinction[0], this->states.transmittance[ray],
      this->states.density[ray]);
    this->states.ahead[ray] *= this->states.transmittance[ray];
  }

  /// Through a layer whose voxels are final.
  LIMPID_HD LIMPID_INLINE void Carry(int s, int i, int j, RayBehind& state) const
  {
    LayerOfRay layer = this->LayerAt(s, i, j);
    layer.Sample(this->rays, this->next, this->importance, s, i, j);
    layer.Carry(state);
    this->states.collected[this->rays.RayAt(i, j)] += layer.DepthFromEntry();
  }

  /// From the first slice of voxels out of the volume.
  LIMPID_HD LIMPID_INLINE void Leave(int i, int j) const
  {
    const Index ray = this->rays.RayAt(i, j);
    RayBehind state(this->states, ray);
    for (int s = this->rays.firstNodeSlice; s >= 0; --s)
    {
      if (s < this->rays.lastSlice && this->rays.Works(s, i, j))
      {
        this->Carry(s, i, j, state);
      }
    }
    this->totals.visible[ray] = state.Visible();
    this->totals.unattenuated[ray] = state.unattenuated;
  }

  LIMPID_HD LIMPID_INLINE void FindVoxel(int s, int u, int v) const
  {
    const Index line = Index(s) * this->rays.nodesV + v;
    const Range<int>& filled = this->rays.voxelFilled[line];
    if (u < filled.begin || u >= filled.end)
    {
      return;
    }
    const SliceView& slice = this->rays.slices[s];
    const Index voxel = this->rays.VoxelAt(slice.node, u, v);
    const float elsewhere = this->lagged ? this->lagged[voxel] : 0.0f;
    const Range<int>& work = this->rays.voxelWork[line];
    float slope = 0;
    if (u >= work.begin && u < work.end)
    {
      const TransmittanceImages images{ this->states.transmittance, this->states.density };
      const SeenAtVoxel seen = this->trust
        ? images.Average(this->rays, this->states.ahead, s, u, v)
        : SeenAtVoxel{ 1.0f, this->rays.AverageRays(this->states.ahead, s, u, v) };
      const GradientVoxel<float> derivative{ 1.0f /
        (this->widens ? slice.scale * slice.scale : 1.0f) };
      slope = derivative(seen.transmittance, seen.behind,
        this->rays.VoxelSeen(s, u, v) * this->nodeImportance[voxel]);
    }
    this->next[voxel] = this->policy(this->base[voxel], slope, elsewhere);
  }
};
}

#endif
