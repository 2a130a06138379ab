// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_SingleSampler_h
#define limpid_render_SingleSampler_h

#include "render/Classification.h"
#include "render/ScalarNodes.h"
#include "render/Trilinear.h"

namespace limpid
{
/// The entries of the transfer functions at both ends of a segment.
struct SingleOptics
{
  OpticalEntry front = {};
  OpticalEntry rear = {};

  /// Advances to the next sample, at this table position.
  LIMPID_HD LIMPID_INLINE void Read(const OpticalTable& table, float position)
  {
    this->front = this->rear;
    this->rear = table.Look(position);
  }

  /// Returns the extinction at the rear of the segment [majorant], and its integral up to there.
  LIMPID_HD LIMPID_INLINE void Extinction(float& value, float& integral) const
  {
    value = this->rear.value[0];
    integral = this->rear.integral[0];
  }

  /// Returns the colour of a segment by the weights of SegmentMean.
  LIMPID_HD LIMPID_INLINE FourFloats Color(int, float ofValues, float ofIntegrals) const
  {
    return ofValues * (this->front.value + this->rear.value) +
      ofIntegrals * (this->rear.integral - this->front.integral);
  }
};

/// Takes the samples of a ray one by one: for devices. BlockSampler performs these operations in
/// the same order in vector registers.
struct SingleSampler
{
  using Lanes = float;
  using Integers = std::int32_t;
  using Cells = Index;
  using Optical = FourFloats;
  using Optics = SingleOptics;
  static constexpr int count = 1; ///< samples at a time

  /// Returns 0 to count - 1.
  LIMPID_HD static LIMPID_INLINE float Numbers() { return 0; }

  LIMPID_HD static LIMPID_INLINE float First(float samples) { return samples; }
  LIMPID_HD static LIMPID_INLINE int Last(int samples) { return samples; }

  /// Returns the last of the previous samples, followed by all but the last of the present ones.
  LIMPID_HD static LIMPID_INLINE float Shifted(float before, float) { return before; }

  LIMPID_HD static LIMPID_INLINE Index CellOf(Index cell, int) { return cell; }

  /// Reads four numbers.
  LIMPID_HD static LIMPID_INLINE FourFloats Loaded(const FourFloats& numbers)
  {
    return LoadAtOnce(numbers);
  }

  /// Returns the first nodes of cells.
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

  /// Devices have floats.
  LIMPID_HD static LIMPID_INLINE float InterpolateAll(
    const CellGrid& grid, const ScalarNodes& field, const CellPlaces<SingleSampler>& place)
  {
    return InterpolateAll(grid, field.Floats(), place);
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

  /// Computes the transmittance in front of each segment, given the shares `passed` of the
  /// segments. `transmittance`: in front of the first segment; becomes that behind the last segment
  /// with more than `opaqueBelow` in front.
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
