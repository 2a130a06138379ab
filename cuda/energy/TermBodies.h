// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What one ray, or one voxel, of a device does in a sweep. The mathematics is in HalfLayer.h,
// RayLayer.h and GradientVoxel.h.

#ifndef limpid_energy_TermBodies_h
#define limpid_energy_TermBodies_h

#include "backend/Extent.h"
#include "energy/GradientVoxel.h"
#include "sweep/PyramidView.h"

namespace limpid
{
/// One value per ray of a pyramid, see RayImages.
struct RayStates
{
  double* opticalDepth; ///< from the eye to the station that the sweep has reached
  float* behind;        ///< visible importance behind, times scale^2
  float* transmittance; ///< from the eye to the station [0, 1]
  float* density;       ///< near the sides, see Densified
  float* ahead;         ///< what `behind` is half way to the station behind
};

/// A ray in the layer behind a station: what is sampled at both Gauss points.
struct LayerOfRay
{
  Layer layer;
  float length;
  Clip column;
  Clip row;
  float extinction[2];
  float importance[2];

  LIMPID_HD LIMPID_INLINE LayerOfRay(const PyramidView& rays, int s, int i, int j)
    : layer(rays.stations[s].layer)
    , length(rays.length[rays.RayAt(i, j)])
    , column(rays.columnClips[i])
    , row(rays.rowClips[j])
    , extinction{ 0, 0 }
    , importance{ 0, 0 }
  {
  }

  LIMPID_HD LIMPID_INLINE void Sample(const PyramidView& rays, const float* extinctions,
    const float* importances, int s, int i, int j)
  {
    const float seen = rays.Seen(i, j);
    for (int half = 0; half < 2; ++half)
    {
      this->extinction[half] = rays.SamplePlane(extinctions, s, half, i, j);
      this->importance[half] = seen * rays.SamplePlane(importances, s, half, i, j);
    }
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
    float sum = 0;
    for (int half = 0; half < 2; ++half)
    {
      sum +=
        WholeHalf<float>(this->layer, HalfRangeOf(half), this->length, this->extinction[half], 0.0f)
          .LimitedDepth();
    }
    return sum;
  }

  /// Visible importance carried from the back of the layer to its front.
  LIMPID_HD LIMPID_INLINE float Carry(float behind) const
  {
    const float middle = Carried(this->Half<Cut::Exit>(1), behind);
    return Carried(this->Half<Cut::Exit>(0), middle);
  }
};

/// From the front to the back of the volume.
struct ForwardRay
{
  PyramidView rays;
  const float* extinction;
  const float* importance;
  double* opticalDepth; ///< out, per ray; null: not wanted
  float* visible;       ///< out, per ray
  float* plain;         ///< out, per ray

  LIMPID_HD void operator()(int i, int j) const
  {
    double depth = 0;
    float seen = 0;
    float all = 0;
    for (int s = 0; s < this->rays.lastStation; ++s)
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
      all += front.plain + rear.plain;
      depth += here.Half<Cut::Entry>(0).LimitedDepth() + here.Half<Cut::Entry>(1).LimitedDepth();
    }
    const Index ray = this->rays.RayAt(i, j);
    if (this->opticalDepth)
    {
      this->opticalDepth[ray] = depth;
    }
    this->visible[ray] = seen;
    this->plain[ray] = all;
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

/// What voxels read of a ray at station `s`: transmittance, and density next to the sides.
LIMPID_HD LIMPID_INLINE void TransmitRay(const PyramidView& rays, int s, int i, int j,
  double opticalDepth, float extinctionBehind, float& transmittance, float& density)
{
  constexpr float unlimited = 1e30f;
  const float depth = static_cast<float>(opticalDepth);
  transmittance = Transmitted(depth);
  density = Densified(depth, rays.stations[s].layer.front - rays.EntryOfRay(i, j),
    extinctionBehind * rays.length[rays.RayAt(i, j)], true, unlimited);
}

/// From the back to the front through several slices of a fixed extinction; leaves an image of the
/// rays on each of them.
struct BackwardRay
{
  PyramidView rays;
  const float* extinction;
  const float* importance;
  bool widens; ///< whether rays carry the weight of Deviation D1
  int begin;   ///< stations
  int end;
  RayStates states;
  float* images; ///< per station: behind, transmittance, density, one value per ray each

  LIMPID_HD void operator()(int i, int j) const
  {
    const Index ray = this->rays.RayAt(i, j);
    const Index count = Index(this->rays.columns) * this->rays.rows;
    double depth = this->states.opticalDepth[ray];
    float behind = this->states.behind[ray];
    float transmittance = this->states.transmittance[ray];
    float density = this->states.density[ray];
    for (int s = this->end - 1; s >= this->begin; --s)
    {
      if (this->rays.Works(s, i, j))
      {
        LayerOfRay here(this->rays, s, i, j);
        if (s < this->rays.lastStation)
        {
          here.Sample(this->rays, this->extinction, this->importance, s, i, j);
          if (!this->widens)
          {
            here.layer.frontScale = here.layer.backScale = 1;
          }
          behind = here.Carry(behind);
          depth -= here.WholeDepth();
        }
        TransmitRay(this->rays, s, i, j, depth, here.extinction[0], transmittance, density);
      }
      float* image = this->images + 3 * count * (s - this->begin) + ray;
      image[0] = behind;
      image[count] = transmittance;
      image[2 * count] = density;
    }
    this->states.opticalDepth[ray] = depth;
    this->states.behind[ray] = behind;
    this->states.transmittance[ray] = transmittance;
    this->states.density[ray] = density;
  }
};

/// The derivative at the voxels of these slices.
struct GradientOfVoxel
{
  PyramidView rays;
  bool widens;
  int begin; ///< stations
  const float* images;
  const float* nodeImportance;
  float weight;
  float* gradient;

  /// `row`: slice by slice, nodesV each.
  LIMPID_HD void operator()(int u, int row) const
  {
    const int s = this->begin + row / this->rays.nodesV;
    const int v = row % this->rays.nodesV;
    const Interval& work = this->rays.voxelWork[Index(s) * this->rays.nodesV + v];
    if (u < work.begin || u >= work.end)
    {
      return;
    }
    const Index count = Index(this->rays.columns) * this->rays.rows;
    const float* image = this->images + 3 * count * (s - this->begin);
    const StationView& station = this->rays.stations[s];
    const TransmittanceImages transmittance{ image + count, image + 2 * count };
    const Index voxel = this->rays.VoxelAt(station.slice, u, v);
    const float area = this->widens ? station.scale * station.scale : 1.0f;
    const GradientVoxel<float> derivative{ 1.0f / area };
    this->gradient[voxel] += this->weight *
      derivative(transmittance(this->rays, s, u, v), this->rays.SampleRays(image, s, u, v),
        this->rays.VoxelSeen(s, u, v) * this->nodeImportance[voxel]);
  }
};
}

#endif
