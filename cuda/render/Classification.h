// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Transfer functions as the rays read them.

#ifndef limpid_render_Classification_h
#define limpid_render_Classification_h

#include "math/Number.h"
#include "render/PackedNumbers.h"
#include "render/Renderer.h"

#include <cmath>
#include <vector>

namespace limpid
{
/// The entries of a table, between which it is linear, as positions from 0 to the last.
struct TableAxis
{
  float low = 0;
  float scale = 1;
  int last = 0; ///< index of the last entry
  float lastPosition = 0;

  TableAxis() = default;

  /// So many entries, two or more, over scalars from `lowest` to `highest`.
  TableAxis(double lowest, double highest, std::size_t entries)
    : low(static_cast<float>(lowest))
    , scale(static_cast<float>(double(entries - 1) / (highest - lowest)))
    , last(static_cast<int>(entries) - 1)
    , lastPosition(static_cast<float>(this->last))
  {
  }

  /// Position of a scalar in the table; may be outside of it.
  template <class Number>
  LIMPID_HD LIMPID_INLINE Number Position(const Number& scalar) const
  {
    return (scalar - this->low) * this->scale;
  }

  /// The position inside the table that is closest.
  template <class Number>
  LIMPID_HD LIMPID_INLINE Number Inside(const Number& position) const
  {
    return Clamp(position, 0.0f, this->lastPosition);
  }

  /// The entry at or before a position inside, such that there is one behind it, and the share of
  /// the way to that one.
  template <class Number>
  LIMPID_HD LIMPID_INLINE auto Split(const Number& inside, Number& share) const
  {
    const auto before = AtMost(Truncate(inside), this->last - 1);
    share = inside - ToFloat(before);
    return before;
  }
};

/// Transfer functions at one place of the table: extinction [majorant], red, green, blue; and the
/// integrals of their Weighed values from its start.
struct alignas(32) OpticalEntry
{
  FourFloats value;
  FourFloats integral;
};

/**
 * Transfer functions over the table position u = (s - low) scale, and their integrals: the numbers
 * and addresses of a Classification.
 *
 * Between two samples along a ray the scalar is taken as linear. The mean extinction of the segment
 * is then the difference quotient of an integral over the scalar (one-dimensional pre-integration,
 * [EKE01] without the self-attenuation within a segment, which the caller adds), so that a thin
 * feature of the transfer function is never missed between samples. The mean colour is weighed with
 * the extinction plus a thousandth of the majorant, which defines it where nothing absorbs.
 */
struct OpticalTable
{
  static constexpr float colorFloor = 1e-3f;

  TableAxis axis;
  const OpticalEntry* entries = nullptr; ///< axis.last + 1
  const float* maxima = nullptr; ///< [level][axis.last + 1]: largest of 2^level entries from i on

  /// Extinction [majorant] and colour at a table position.
  LIMPID_HD LIMPID_INLINE FourFloats At(float position) const
  {
    float share;
    const OpticalEntry* entry =
      this->entries + this->axis.Split(this->axis.Inside(position), share);
    return Blend(entry[0].value, entry[1].value, share);
  }

  /// Returns the value and its integral from the start of the table.
  LIMPID_HD LIMPID_INLINE OpticalEntry Look(float position) const
  {
    const float inside = this->axis.Inside(position);
    float share;
    const OpticalEntry* entry = this->entries + this->axis.Split(inside, share);
    OpticalEntry there{ Blend(entry[0].value, entry[1].value, share),
      Blend(entry[0].integral, entry[1].integral, share) };
    Extend(there, position - inside);
    return there;
  }

  /// Moves on beyond an end of the table, where the functions are constant.
  LIMPID_HD static LIMPID_INLINE void Extend(OpticalEntry& there, float beyond)
  {
    there.integral = there.integral + beyond * Weighed(there.value);
  }

  /// What the integrals are of.
  LIMPID_HD static LIMPID_INLINE FourFloats Weighed(const FourFloats& value)
  {
    const float weight = value[0] + colorFloor;
    return { { value[0], weight * value[1], weight * value[2], weight * value[3] } };
  }

  /// Largest extinction [majorant] between two table positions.
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
/// the difference of the samples' integrals, and ofValues times the sum of their values.
template <class Number>
struct SegmentMean
{
  Number extinction = 0; ///< [majorant]
  Number ofIntegrals = 0;
  Number ofValues = 0;

  SegmentMean() = default;

  /// `distance`: of the table positions; `integral`: of the extinction between them; `ends`: sum of
  /// both extinctions.
  LIMPID_HD LIMPID_INLINE SegmentMean(
    const Number& distance, const Number& integral, const Number& ends)
  {
    // Close together, the difference of integrals is one of rounding errors.
    const auto wide = Magnitude(distance) > 4.0f;
    const Number perDistance = 1.0f / Select(wide, distance, 1.0f);
    this->extinction = Select(wide, perDistance * integral, 0.5f * ends);
    const Number weight = this->extinction + OpticalTable::colorFloor;
    this->ofIntegrals = Select(wide, perDistance / weight, 0.0f);
    this->ofValues = Select(wide, 0.0f, Number(0.5f));
  }
};

/// Transfer functions as rays read them, see OpticalTable.
class Classification
{
public:
  Classification() = default;
  explicit Classification(const TransferFunctions& functions);

  /// Numbers and addresses, which hold as long as this object stays where it is.
  OpticalTable Table() const;

  float Majorant() const { return this->LargestExtinction; } ///< [1/length]
  bool Empty() const { return this->All.empty(); }

  /// Whether all scalars have the same extinction.
  bool IsUniform() const { return this->HasOneExtinction; }

  const std::vector<OpticalEntry>& Entries() const { return this->All; }
  const std::vector<float>& LargestOfEntries() const { return this->Maxima; }

private:
  TableAxis Axis;
  float LargestExtinction = 0;
  bool HasOneExtinction = false;
  std::vector<OpticalEntry> All; ///< see OpticalTable, like the other
  std::vector<float> Maxima;
};
}

#endif
