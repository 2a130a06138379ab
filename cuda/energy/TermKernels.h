// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What one ray, or one voxel, of a device does in a sweep. The mathematics is in HalfLayer.h,
// RayLayer.h and GradientVoxel.h.

#ifndef limpid_energy_TermBodies_h
#define limpid_energy_TermBodies_h

#include "backend/Extent.h"
#include "energy/GradientVoxel.h"
#include "sweep/FrustumView.h"

namespace limpid
{
/// One value per ray of a frustum, see RayImages.
struct RayStates
{
  double* opticalDepth; ///< from the eye to the slice that the sweep has reached
  float* behind;        ///< visible importance behind, times scale^2
  float* visible;       ///< ... from the entry into the box on, see FromEntry
  float* unattenuated;  ///< the same without attenuation
  float* transmittance; ///< from the eye to the slice [0, 1]
  float* density;       ///< near the sides, see Densified
  float* ahead;         ///< what `behind` is half way to the slice behind, times transmittance
  double* collected;    ///< optical depth of the layers that a sweep from the back has passed
};

/// What a ray carries from the back to the front, see RaysBehind.
struct RayBehind
{
  float behind;
  float visible;
  float unattenuated;

  LIMPID_HD LIMPID_INLINE RayBehind(const RayStates& states, Index ray)
    : behind(states.behind[ray])
    , visible(states.visible[ray])
    , unattenuated(states.unattenuated[ray])
  {
  }

  LIMPID_HD LIMPID_INLINE void Store(const RayStates& states, Index ray) const
  {
    states.behind[ray] = this->behind;
    states.visible[ray] = this->visible;
    states.unattenuated[ray] = this->unattenuated;
  }

  /// Of the whole ray, when it is through.
  LIMPID_HD LIMPID_INLINE float Visible() const
  {
    return this->visible < 0 ? this->behind : this->visible;
  }
};

/// A ray in the layer behind a slice: what is sampled at both Gauss points.
struct LayerOfRay
{
  Layer layer;
  float length;
  Range<float> column;
  Range<float> row;
  float extinction[2];
  float importance[2];

  LIMPID_HD LIMPID_INLINE LayerOfRay(const FrustumView& rays, int s, int i, int j)
    : layer(rays.slices[s].layer)
    , length(rays.length[rays.RayAt(i, j)])
    , column(rays.columnClips[i])
    , row(rays.rowClips[j])
    , extinction{ 0, 0 }
    , importance{ 0, 0 }
  {
  }

  LIMPID_HD LIMPID_INLINE void SampleExtinction(
    const FrustumView& rays, const float* extinctions, int s, int i, int j)
  {
    for (int half = 0; half < 2; ++half)
    {
      this->extinction[half] = rays.SamplePlane(extinctions, s, half, i, j);
    }
  }

  LIMPID_HD LIMPID_INLINE void Sample(const FrustumView& rays, const float* extinctions,
    const float* importances, int s, int i, int j)
  {
    this->SampleExtinction(rays, extinctions, s, i, j);
    const float seen = rays.Seen(i, j);
    for (int half = 0; half < 2; ++half)
    {
      this->importance[half] = seen * rays.SamplePlane(importances, s, half, i, j);
    }
  }

  LIMPID_HD LIMPID_INLINE float Entry() const
  {
    return this->column.begin > this->row.begin ? this->column.begin : this->row.begin;
  }

  /// Whether the ray is in the box from the front of the layer to its back.
  LIMPID_HD LIMPID_INLINE bool IsInside() const
  {
    const float exit = this->column.end < this->row.end ? this->column.end : this->row.end;
    return this->Entry() <= this->layer.front && exit >= this->layer.front + this->layer.thickness;
  }

  template <Cut cut>
  LIMPID_HD LIMPID_INLINE HalfLayer<float> Half(int half) const
  {
    return CutHalf<cut>(this->layer, half, this->length, this->extinction[half],
      this->importance[half], this->column, this->row);
  }

  /// Optical depth of the whole layer, whether the ray is in the box or not.
  LIMPID_HD LIMPID_INLINE float WholeDepth() const
  {
    return DepthOf(this->Whole(0), this->Whole(1));
  }

  /// Optical depth from the entry into the box on.
  LIMPID_HD LIMPID_INLINE float DepthFromEntry() const
  {
    return DepthOf(this->Half<Cut::Entry>(0), this->Half<Cut::Entry>(1));
  }

  /// Carries visible importance from the back of the layer to its front.
  LIMPID_HD LIMPID_INLINE void Carry(RayBehind& state) const
  {
    const bool inside = this->IsInside();
    const HalfLayer<float> front = inside ? this->Whole(0) : this->Half<Cut::Both>(0);
    const HalfLayer<float> rear = inside ? this->Whole(1) : this->Half<Cut::Both>(1);
    state.unattenuated += front.unattenuated + rear.unattenuated;
    const float carried = Carried(front, rear, state.behind);
    if (inside)
    {
      state.behind = carried;
      return;
    }
    state.visible = FromEntry(state.visible, this->Entry(), this->layer, carried);
    state.behind = Carried(this->Half<Cut::Exit>(0), this->Half<Cut::Exit>(1), state.behind);
  }

private:
  LIMPID_HD LIMPID_INLINE HalfLayer<float> Whole(int half) const
  {
    return WholeHalf<float>(
      this->layer, RangeOfHalf(half), this->length, this->extinction[half], this->importance[half]);
  }
};

/// What rays add up to all through the volume, one value each.
struct RayTotals
{
  float* visible;
  float* unattenuated;
};

/// From the front to the back of the volume.
struct ForwardRay
{
  FrustumView rays;
  const float* extinction;
  const float* importance;
  double* opticalDepth; ///< out, per ray; null: not wanted
  RayTotals totals;     ///< out

  LIMPID_HD void operator()(int i, int j) const
  {
    double depth = 0;
    float seen = 0;
    float all = 0;
    for (int s = 0; s < this->rays.lastSlice; ++s)
    {
      if (!this->rays.Works(s, i, j))
      {
        continue;
      }
      LayerOfRay here(this->rays, s, i, j);
      here.Sample(this->rays, this->extinction, this->importance, s, i, j);
      const HalfLayer<float> front = here.Half<Cut::Both>(0);
      const HalfLayer<float> rear = here.Half<Cut::Both>(1);
      seen +=
        Attenuate(static_cast<float>(depth)) * (front.visible + front.Passed() * rear.visible);
      all += front.unattenuated + rear.unattenuated;
      depth += here.DepthFromEntry();
    }
    const Index ray = this->rays.RayAt(i, j);
    if (this->opticalDepth)
    {
      this->opticalDepth[ray] = depth;
    }
    this->totals.visible[ray] = seen;
    this->totals.unattenuated[ray] = all;
  }
};

/// The same for the optical depth alone.
struct DepthRay
{
  FrustumView rays;
  const float* extinction;
  double* opticalDepth; ///< out, per ray

  LIMPID_HD void operator()(int i, int j) const
  {
    double depth = 0;
    for (int s = 0; s < this->rays.lastSlice; ++s)
    {
      if (this->rays.Works(s, i, j))
      {
        LayerOfRay here(this->rays, s, i, j);
        here.SampleExtinction(this->rays, this->extinction, s, i, j);
        depth += here.DepthFromEntry();
      }
    }
    this->opticalDepth[this->rays.RayAt(i, j)] = depth;
  }
};

/// What a ray adds to an integral over the domain.
struct WeightedRay
{
  const double* shares;
  const float* values;

  LIMPID_HD LIMPID_INLINE double operator()(Index ray) const
  {
    return this->shares[ray] * this->values[ray];
  }
};

/// What voxels read of a ray at slice `s`: transmittance, and density next to the sides.
LIMPID_HD LIMPID_INLINE void TransmitRay(const FrustumView& rays, int s, int i, int j,
  double opticalDepth, float extinctionBehind, float& transmittance, float& density)
{
  constexpr float unlimited = 1e30f;
  const float depth = static_cast<float>(opticalDepth);
  transmittance = Transmitted(depth);
  density = Densified(depth, rays.slices[s].layer.front - rays.EntryOfRay(i, j),
    extinctionBehind * rays.length[rays.RayAt(i, j)], true, unlimited);
}

/// From the back to the front through several slices of a fixed extinction; leaves an image of the
/// rays on each of them.
struct BackwardRay
{
  FrustumView rays;
  const float* extinction;
  const float* importance;
  bool widens; ///< whether rays carry the weight of Deviation D1
  int begin;   ///< slices
  int end;
  RayStates states;
  float* images;    ///< per slice: what transmittance leaves of what is behind, transmittance,
                    ///< density, one value per ray each
  RayTotals totals; ///< out, when the sweep comes to the front

  LIMPID_HD void operator()(int i, int j) const
  {
    const Index ray = this->rays.RayAt(i, j);
    const Index count = Index(this->rays.columns) * this->rays.rows;
    double depth = this->states.opticalDepth[ray];
    RayBehind state(this->states, ray);
    float transmittance = this->states.transmittance[ray];
    float density = this->states.density[ray];
    for (int s = this->end - 1; s >= this->begin; --s)
    {
      if (this->rays.Works(s, i, j))
      {
        LayerOfRay here(this->rays, s, i, j);
        if (s < this->rays.lastSlice)
        {
          this->Carry(s, i, j, here, state);
          depth -= here.WholeDepth();
        }
        TransmitRay(this->rays, s, i, j, depth, here.extinction[0], transmittance, density);
      }
      float* image = this->images + 3 * count * (s - this->begin) + ray;
      image[0] = transmittance * state.behind;
      image[count] = transmittance;
      image[2 * count] = density;
    }
    if (this->begin == this->rays.firstNodeSlice)
    {
      this->Leave(i, j, state);
    }
    this->states.opticalDepth[ray] = depth;
    state.Store(this->states, ray);
    this->states.transmittance[ray] = transmittance;
    this->states.density[ray] = density;
  }

private:
  LIMPID_HD LIMPID_INLINE void Carry(int s, int i, int j, LayerOfRay& here, RayBehind& state) const
  {
    here.Sample(this->rays, this->extinction, this->importance, s, i, j);
    if (!this->widens)
    {
      here.layer.frontScale = here.layer.backScale = 1;
    }
    here.Carry(state);
  }

  /// From the first slice of voxels to the eye.
  LIMPID_HD LIMPID_INLINE void Leave(int i, int j, RayBehind& state) const
  {
    for (int s = this->rays.firstNodeSlice; s-- > 0;)
    {
      if (this->rays.Works(s, i, j))
      {
        LayerOfRay here(this->rays, s, i, j);
        this->Carry(s, i, j, here, state);
      }
    }
    const Index ray = this->rays.RayAt(i, j);
    this->totals.visible[ray] = state.Visible();
    this->totals.unattenuated[ray] = state.unattenuated;
  }
};

/// The derivative at the voxels of these slices.
struct GradientOfVoxel
{
  FrustumView rays;
  bool widens;
  int begin; ///< slices
  const float* images;
  const float* nodeImportance;
  GradientTarget target;

  /// `row`: slice by slice, nodesV each.
  LIMPID_HD void operator()(int u, int row) const
  {
    const int s = this->begin + row / this->rays.nodesV;
    const int v = row % this->rays.nodesV;
    const Range<int>& work = this->rays.voxelWork[Index(s) * this->rays.nodesV + v];
    if (u < work.begin || u >= work.end)
    {
      return;
    }
    const Index count = Index(this->rays.columns) * this->rays.rows;
    const float* image = this->images + 3 * count * (s - this->begin);
    const SliceView& slice = this->rays.slices[s];
    const TransmittanceImages transmittance{ image + count, image + 2 * count };
    const Index voxel = this->rays.VoxelAt(slice.node, u, v);
    const float area = this->widens ? slice.scale * slice.scale : 1.0f;
    const GradientVoxel<float> derivative{ 1.0f / area };
    float& here = this->target.field[voxel];
    const SeenAtVoxel seen = transmittance.Average(this->rays, image, s, u, v);
    here = this->target.Of(here,
      derivative(seen.transmittance, seen.behind,
        this->rays.VoxelSeen(s, u, v) * this->nodeImportance[voxel]));
  }
};
}

#endif
