// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Transfer functions in the form that rays read.

#ifndef limpid_render_Classification_h
#define limpid_render_Classification_h

#include "math/Number.h"
#include "render/PackedNumbers.h"
#include "render/Renderer.h"

#include <cmath>
#include <vector>

namespace limpid
{
/// The positions of the entries of a table, from 0 to the last. The table is linear in between.
struct TableAxis
{
  float low = 0;
  float scale = 1;
  int last = 0; ///< index of the last entry
  float lastPosition = 0;

  TableAxis() = default;

  /// Two or more entries, equally spaced over scalars from `lowest` to `highest`.
  TableAxis(double lowest, double highest, std::size_t entries)
    : low(static_cast<float>(lowest))
    , scale(static_cast<float>(double(entries - 1) / (highest - lowest)))
    , last(static_cast<int>(entries) - 1)
    , lastPosition(static_cast<float>(this->last))
  {
  }

  /// Returns the position of a scalar in the table; it may be outside.
  template <class Number>
  LIMPID_HD LIMPID_INLINE Number Position(const Number& scalar) const
  {
    return (scalar - this->low) * this->scale;
  }

  /// Returns a position clamped to the table.
  template <class Number>
  LIMPID_HD LIMPID_INLINE Number Inside(const Number& position) const
  {
    return Clamp(position, 0.0f, this->lastPosition);
  }

  /// Returns the entry at or before a position inside, such that there is a next one, and the
  /// fraction of the way to that one.
  template <class Number>
  LIMPID_HD LIMPID_INLINE auto Split(const Number& inside, Number& share) const
  {
    const auto before = AtMost(Truncate(inside), this->last - 1);
    share = inside - ToFloat(before);
    return before;
  }
};

/// Transfer functions at one entry of the table: extinction [majorant], red, green, blue; and the
/// integrals of their Weighed values from the start of the table.
struct alignas(32) OpticalEntry
{
  FourFloats value;
  FourFloats integral;
};

/**
 * Transfer functions over the table position u = (s - low) scale, with their integrals: the numbers
 * and addresses of a Classification.
 *
 * The scalar is assumed linear between two samples of a ray. The mean extinction of the segment is
 * then the difference quotient of an integral over the scalar, so that a thin feature of the
 * transfer function is never missed between samples. (This is the one-dimensional pre-integration
 * of [EKE01] without self-attenuation within a segment, which the caller adds.) The mean colour is
 * weighted by the extinction plus a thousandth of the majorant, so that it is defined where nothing
 * absorbs.
 */
struct OpticalTable
{
  static constexpr float colorFloor = 1e-3f;

  TableAxis axis;
  const OpticalEntry* entries = nullptr; ///< axis.last + 1
  const float* maxima = nullptr; ///< [level][axis.last + 1]: maximum of 2^level entries from i on

  /// Returns extinction [majorant] and colour at a table position.
  LIMPID_HD LIMPID_INLINE FourFloats At(float position) const
  {
    float share;
    const OpticalEntry* entry =
      this->entries + this->axis.Split(this->axis.Inside(position), share);
    return Blend(LoadAtOnce(entry[0].value), LoadAtOnce(entry[1].value), share);
  }

  /// Returns the value and its integral from the start of the table.
  LIMPID_HD LIMPID_INLINE OpticalEntry Look(float position) const
  {
    const float inside = this->axis.Inside(position);
    float share;
    const OpticalEntry* entry = this->entries + this->axis.Split(inside, share);
    OpticalEntry there{ Blend(LoadAtOnce(entry[0].value), LoadAtOnce(entry[1].value), share),
      Blend(LoadAtOnce(entry[0].integral), LoadAtOnce(entry[1].integral), share) };
    Extend(there, position - inside);
    return there;
  }

  /// Extends the integrals beyond an end of the table, where the functions are constant.
  LIMPID_HD static LIMPID_INLINE void Extend(OpticalEntry& there, float beyond)
  {
    there.integral = there.integral + beyond * Weighed(there.value);
  }

  /// Returns the integrand of the integrals.
  LIMPID_HD static LIMPID_INLINE FourFloats Weighed(const FourFloats& value)
  {
    const float weight = value[0] + colorFloor;
    return { { value[0], weight * value[1], weight * value[2], weight * value[3] } };
  }

  /// Returns the largest extinction between two table positions [majorant].
  LIMPID_HD LIMPID_INLINE float LargestBetween(float from, float to) const
  {
    const int first = static_cast<int>(this->axis.Inside(from));
    const int end = static_cast<int>(std::ceil(this->axis.Inside(to))) + 1;
    int level = 0;
    while ((2 << level) <= end - first)
    {
      ++level;
    }
    const float* largest = this->maxima + level * (this->axis.last + 1);
    const float front = largest[first];
    const float back = largest[end - (1 << level)];
    return front > back ? front : back;
  }
};

/// The mean of transfer functions on a segment between two samples. Its colour is ofIntegrals times
/// the difference of the samples' integrals plus ofValues times the sum of their values.
template <class Number>
struct SegmentMean
{
  Number extinction = 0; ///< [majorant]
  Number ofIntegrals = 0;
  Number ofValues = 0;

  SegmentMean() = default;

  /// `distance`: difference of the table positions; `integral`: of the extinction between them;
  /// `ends`: sum of both extinctions.
  LIMPID_HD LIMPID_INLINE SegmentMean(
    const Number& distance, const Number& integral, const Number& ends)
  {
    // For close positions, the difference of integrals consists of rounding errors.
    const auto wide = Magnitude(distance) > 4.0f;
    const Number perDistance = 1.0f / Select(wide, distance, 1.0f);
    this->extinction = Select(wide, perDistance * integral, 0.5f * ends);
    const Number weight = this->extinction + OpticalTable::colorFloor;
    this->ofIntegrals = Select(wide, perDistance / weight, 0.0f);
    this->ofValues = Select(wide, 0.0f, Number(0.5f));
  }
};

/// Transfer functions in the form that rays read, see OpticalTable.
class Classification
{
public:
  Classification() = default;
  explicit Classification(const TransferFunctions& functions);

  /// Returns numbers and addresses, which are valid until this object is moved.
  OpticalTable Table() const;

  float Majorant() const { return this->LargestExtinction; } ///< [1/length]
  bool Empty() const { return this->All.empty(); }

  /// Returns whether all scalars have the same extinction.
  bool IsUniform() const { return this->HasOneExtinction; }

  const std::vector<OpticalEntry>& Entries() const { return this->All; }
  const std::vector<float>& LargestOfEntries() const { return this->Maxima; }

private:
  TableAxis Axis;
  float LargestExtinction = 0;
  bool HasOneExtinction = false;
  std::vector<OpticalEntry> All; ///< entries and maxima, see OpticalTable
  std::vector<float> Maxima;
};
}

#endif
