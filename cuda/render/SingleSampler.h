// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_SingleSampler_h
#define limpid_render_SingleSampler_h

#include "render/Classification.h"
#include "render/Trilinear.h"

namespace limpid
{
/// What the transfer functions say at both ends of a segment.
struct SingleOptics
{
  OpticalEntry front = {};
  OpticalEntry rear = {};

  /// Moves on to the next sample, which is at this table position.
  LIMPID_HD LIMPID_INLINE void Read(const OpticalTable& table, float position)
  {
    this->front = this->rear;
    this->rear = table.Look(position);
  }

  /// Extinction at the rear of the segments [majorant], and its integral to there.
  LIMPID_HD LIMPID_INLINE void Extinction(float& value, float& integral) const
  {
    value = this->rear.value[0];
    integral = this->rear.integral[0];
  }

  /// The colour of a segment by the weights of SegmentMean.
  LIMPID_HD LIMPID_INLINE FourFloats Color(int, float ofValues, float ofIntegrals) const
  {
    return ofValues * (this->front.value + this->rear.value) +
      ofIntegrals * (this->rear.integral - this->front.integral);
  }
};

/// Takes the samples of a ray one by one, number by number: for devices. BlockSampler does the same
/// in the same order of operations with the registers of the processor.
struct SingleSampler
{
  using Lanes = float;
  using Integers = std::int32_t;
  using Cells = Index;
  using Optical = FourFloats;
  using Optics = SingleOptics;
  static constexpr int count = 1; ///< samples at a time

  /// 0 to count - 1.
  LIMPID_HD static LIMPID_INLINE float Numbers() { return 0; }

  LIMPID_HD static LIMPID_INLINE float First(float samples) { return samples; }
  LIMPID_HD static LIMPID_INLINE int Last(int samples) { return samples; }

  /// The last of some samples, and all but the last of those behind them.
  LIMPID_HD static LIMPID_INLINE float Shifted(float before, float) { return before; }

  /// The first nodes of cells.
  LIMPID_HD static LIMPID_INLINE void FindFirst(
    const CellGrid& grid, const int* before, Index& first)
  {
    first = grid.First(before[0], before[1], before[2]);
  }

  /// Interpolates a field at the samples.
  LIMPID_HD static LIMPID_INLINE float InterpolateAll(
    const CellGrid& grid, const float* field, const CellPlaces<SingleSampler>& place)
  {
    return InCell(
      grid, field + place.cell, place.fraction[0], place.fraction[1], place.fraction[2]);
  }

  /// Interpolates packed numbers at the samples [packedOne].
  template <int Count>
  LIMPID_HD static LIMPID_INLINE void InterpolateAll(const CellGrid& grid,
    const Packed<Count>* field, const CellPlaces<SingleSampler>& place, float (&numbers)[Count])
  {
    const Floats<Count> all =
      InCell(grid, field + place.cell, place.fraction[0], place.fraction[1], place.fraction[2]);
    for (int number = 0; number < Count; ++number)
    {
      numbers[number] = all[number];
    }
  }

  /// The transmittance in front of each of some segments that let `passed` through. The one given,
  /// in front of the first, becomes that behind the last segment with more than `opaqueBelow` in
  /// front.
  LIMPID_HD static LIMPID_INLINE float InFront(float passed, float, float& transmittance)
  {
    const float before = transmittance;
    transmittance = before * passed;
    return before;
  }
};

using CellPlace = CellPlaces<SingleSampler>;
}

#endif
