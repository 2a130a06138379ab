// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Resolved layers of a row of rays, on the processor: sixteen rays side by side. ResolvedLayer.h
// resolves the layer of a single ray, with the same formulas and bits.

#ifndef limpid_sweep_ResolvedRows_h
#define limpid_sweep_ResolvedRows_h

#include "sweep/FaceFrustum.h"
#include "sweep/ResolvedLayer.h"

namespace limpid
{
struct SliceWindow;
struct RayRow;

/// Rays of a row, one per lane, and their light in a resolved layer.
struct RaysInLanes
{
  static constexpr int most = 16; ///< FloatLanes::count; compilers for devices read this header

  int count = 0;
  int column[most];
  float sampled[most]; ///< see ResolvedRay [1/length]
  float densest[most]; ///< see ResolvedRay [1/length]
  float behind[most];  ///< visible importance behind; needed for effects
  LayerLight light[most];
  LayerEffect effect[most];

  void Add(int ofColumn, float sampledThere, float densestThere, float behindThere)
  {
    this->column[this->count] = ofColumn;
    this->sampled[this->count] = sampledThere;
    this->densest[this->count] = densestThere;
    this->behind[this->count] = behindThere;
    ++this->count;
  }

  /// Gives lanes without a ray the first one, whose values are not used.
  void FillRest()
  {
    for (int lane = this->count; lane < most; ++lane)
    {
      this->column[lane] = this->column[0];
      this->behind[lane] = 0;
    }
  }
};

/// Whether the effects of extinction are computed as well.
enum class Effects
{
  Ignored,
  Found
};

/// The rays of one row in a layer, for sampling between its slices.
struct RowBetweenSlices
{
  const FaceFrustum& frustum;
  int slice; ///< index of the slice in front of the layer
  int row;   ///< index of the row of rays
  const RayRow& rays;
  RayFields<SliceWindow*> fields;

  /// Computes the light of the given rays, and the effects. After FillRest.
  template <class Cuts, Effects effects>
  void FindLight(RaysInLanes& lanes) const;

  /// Raises `extinction` and `importance` to the samples at both ends of the layer.
  void IncludeEnds(const Range<int>& columns, float* extinction, float* importance) const;
};
}

#endif
