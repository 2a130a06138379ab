// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Transfer functions as the rays read them.

#ifndef limpid_render_Classification_h
#define limpid_render_Classification_h

#include "backend/Simd.h"
#include "render/Renderer.h"

#include <vector>

namespace limpid
{
/// Extinction and colour, in one register: extinction, red, green, blue.
using Optical = float __attribute__((vector_size(16)));

LIMPID_INLINE Optical Blend(const Optical& a, const Optical& b, float share)
{
  return a + share * (b - a);
}

/**
 * Transfer functions over the table position u = (s - low) scale, and their integrals.
 *
 * Between two samples along a ray the scalar is taken as linear. The mean extinction of the segment
 * is then the difference quotient of an integral over the scalar (one-dimensional pre-integration,
 * [EKE01] without the self-attenuation within a segment, which the caller adds), so that a thin
 * feature of the transfer function is never missed between samples. The mean colour is weighted
 * with the extinction plus a thousandth of the majorant, which defines it where nothing absorbs.
 */
class Classification
{
public:
  Classification() = default;
  explicit Classification(const TransferFunctions& functions);

  /// Position of a scalar in the table; may be outside of it.
  LIMPID_INLINE float Position(float scalar) const { return (scalar - this->Low) * this->Scale; }

  /// Extinction [majorant] and colour at a table position.
  LIMPID_INLINE Optical At(float position) const
  {
    const float inside = this->Inside(position);
    const std::size_t entry = this->Entry(inside);
    return Blend(this->Values[entry], this->Values[entry + 1], inside - float(int(entry)));
  }

  /// Integrals from the start of the table to some positions: of extinction and of weighted
  /// colours.
  template <int Begin, int End>
  LIMPID_INLINE void IntegralsAt(const float* positions, Optical* integrals) const
  {
    float share[End];
    float beyond[End];
    int entry[End];
    float outside = 0;
    const int lastEntry = this->Last - 1;
    for (int i = Begin; i < End; ++i)
    {
      const float inside = this->Inside(positions[i]);
      const int before = static_cast<int>(inside);
      entry[i] = before < lastEntry ? before : lastEntry;
      share[i] = inside - static_cast<float>(entry[i]);
      beyond[i] = positions[i] - inside;
      outside += beyond[i] < 0.0f ? -beyond[i] : beyond[i];
    }
    for (int i = Begin; i < End; ++i)
    {
      const Optical* values = this->Integrals.data() + entry[i];
      integrals[i] = Blend(values[0], values[1], share[i]);
    }
    if (outside > 0.0f)
    {
      // Constant beyond the table's ends.
      for (int i = Begin; i < End; ++i)
      {
        const Optical& end = beyond[i] > 0.0f ? this->Values.back() : this->Values.front();
        integrals[i] += beyond[i] * this->Weigh(end);
      }
    }
  }

  /// Mean extinction [majorant] and colour of a segment between two table positions, with the
  /// integrals at both.
  LIMPID_INLINE Optical Mean(
    float from, const Optical& integralFrom, float to, const Optical& integralTo) const
  {
    // Close together, the difference would be one of rounding errors.
    const float distance = to - from;
    if (!(distance > 4.0f || distance < -4.0f))
    {
      return this->At(0.5f * (from + to));
    }
    Optical mean = (integralTo - integralFrom) * (1.0f / distance);
    const float extinction = mean[0];
    mean = mean * (1.0f / (extinction + colorFloor));
    mean[0] = extinction;
    return mean;
  }

  float Majorant() const { return this->LargestExtinction; } ///< [1/length]

  /// Largest extinction [majorant] between two table positions.
  float LargestBetween(float from, float to) const;

  bool Empty() const { return this->Values.empty(); }

private:
  static constexpr float colorFloor = 1e-3f;

  LIMPID_INLINE float Inside(float position) const
  {
    const float atLeast = position > 0.0f ? position : 0.0f;
    return atLeast < this->LastPosition ? atLeast : this->LastPosition;
  }

  /// The entry at or before a position inside, such that there is one behind it.
  LIMPID_INLINE std::size_t Entry(float inside) const
  {
    const int entry = static_cast<int>(inside);
    return static_cast<std::size_t>(entry < this->Last ? entry : this->Last - 1);
  }

  LIMPID_INLINE Optical Weigh(const Optical& value) const
  {
    const float weight = value[0] + colorFloor;
    return Optical{ value[0], weight * value[1], weight * value[2], weight * value[3] };
  }

  float Low = 0;
  float Scale = 1;
  int Last = 0; ///< index of the last entry
  float LastPosition = 0;
  float LargestExtinction = 0;
  std::vector<Optical> Values;
  std::vector<Optical> Integrals;
  std::vector<std::vector<float>> Maxima; ///< [level][i]: largest of 2^level entries from i on
};
}

#endif
