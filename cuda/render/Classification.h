// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Transfer functions as the rays read them.

#ifndef limpid_render_Classification_h
#define limpid_render_Classification_h

#include "render/FourFloats.h"
#include "render/Renderer.h"

#include <cmath>
#include <vector>

namespace limpid
{
/**
 * Transfer functions over the table position u = (s - low) scale, and their integrals: the numbers
 * and addresses of a Classification.
 *
 * Between two samples along a ray the scalar is taken as linear. The mean extinction of the segment
 * is then the difference quotient of an integral over the scalar (one-dimensional pre-integration,
 * [EKE01] without the self-attenuation within a segment, which the caller adds), so that a thin
 * feature of the transfer function is never missed between samples. The mean colour is weighed with
 * the extinction plus a thousandth of the majorant, which defines it where nothing absorbs.
 *
 * `Optical`: four floats in a register; extinction [majorant], red, green, blue.
 */
template <class Optical>
struct OpticalTable
{
  static constexpr float colorFloor = 1e-3f;

  float low = 0;
  float scale = 1;
  int last = 0; ///< index of the last entry
  float lastPosition = 0;
  const Optical* values = nullptr;    ///< last + 1
  const Optical* integrals = nullptr; ///< of Weighed values from the start, last + 1
  const float* maxima = nullptr;      ///< [level][last + 1]: largest of 2^level entries from i on

  /// The same table in other registers.
  template <class Register>
  LIMPID_HD LIMPID_INLINE OpticalTable<Register> As() const
  {
    static_assert(sizeof(Register) == sizeof(Optical), "the same four floats");
    return { this->low, this->scale, this->last, this->lastPosition,
      reinterpret_cast<const Register*>(this->values),
      reinterpret_cast<const Register*>(this->integrals), this->maxima };
  }

  /// Position of a scalar in the table; may be outside of it.
  LIMPID_HD LIMPID_INLINE float Position(float scalar) const
  {
    return (scalar - this->low) * this->scale;
  }

  /// Extinction [majorant] and colour at a table position.
  LIMPID_HD LIMPID_INLINE Optical At(float position) const
  {
    const float inside = this->Inside(position);
    const int entry = this->Before(inside);
    return Blend(this->values[entry], this->values[entry + 1], inside - float(entry));
  }

  /// Values at table positions, and integrals from the start of the table to there. The loops have
  /// no branches, for the sake of vector units.
  template <int Begin, int End>
  LIMPID_HD LIMPID_INLINE void Read(
    const float* positions, Optical* valuesThere, Optical* integralsThere) const
  {
    float share[End];
    float beyond[End];
    int entry[End];
    int outside = 0;
    LIMPID_UNROLL(1)
    for (int i = Begin; i < End; ++i)
    {
      const float inside = this->Inside(positions[i]);
      entry[i] = this->Before(inside);
      share[i] = inside - static_cast<float>(entry[i]);
      beyond[i] = positions[i] - inside;
      outside |= static_cast<int>(beyond[i] != 0.0f);
    }
    for (int i = Begin; i < End; ++i)
    {
      const Optical* value = this->values + entry[i];
      const Optical* integral = this->integrals + entry[i];
      valuesThere[i] = Blend(value[0], value[1], share[i]);
      integralsThere[i] = Blend(integral[0], integral[1], share[i]);
    }
    if (outside != 0) // the functions are constant there
    {
      for (int i = Begin; i < End; ++i)
      {
        integralsThere[i] = integralsThere[i] + beyond[i] * Weighed(valuesThere[i]);
      }
    }
  }

  /// What the integrals are of.
  LIMPID_HD static LIMPID_INLINE Optical Weighed(const Optical& value)
  {
    const float weight = value[0] + colorFloor;
    return Optical{ value[0], weight * value[1], weight * value[2], weight * value[3] };
  }

  /// Largest extinction [majorant] between two table positions.
  LIMPID_HD LIMPID_INLINE float LargestBetween(float from, float to) const
  {
    const int first = static_cast<int>(this->Inside(from));
    const int end = static_cast<int>(std::ceil(this->Inside(to))) + 1;
    int level = 0;
    while ((2 << level) <= end - first)
    {
      ++level;
    }
    const float* largest = this->maxima + level * (this->last + 1);
    const float front = largest[first];
    const float back = largest[end - (1 << level)];
    return front > back ? front : back;
  }

private:
  LIMPID_HD LIMPID_INLINE float Inside(float position) const
  {
    const float atLeast = position > 0.0f ? position : 0.0f;
    return atLeast < this->lastPosition ? atLeast : this->lastPosition;
  }

  /// The entry at or before a position inside, such that there is one behind it.
  LIMPID_HD LIMPID_INLINE int Before(float inside) const
  {
    const int before = static_cast<int>(inside);
    const int most = this->last - 1;
    return before < most ? before : most;
  }
};

/// The mean of transfer functions on a segment between two samples. Its colour is ofIntegrals times
/// the difference of the samples' integrals, and ofValues times the sum of their values.
struct SegmentMean
{
  float extinction; ///< [majorant]
  float ofIntegrals;
  float ofValues;

  /// `distance`: of the table positions; `integral`: of the extinction between them; `ends`: sum of
  /// both extinctions.
  LIMPID_HD LIMPID_INLINE SegmentMean(float distance, float integral, float ends)
  {
    // Close together, the difference of integrals is one of rounding errors.
    const bool wide = std::abs(distance) > 4.0f;
    const float perDistance = 1.0f / (wide ? distance : 1.0f);
    this->extinction = wide ? perDistance * integral : 0.5f * ends;
    const float weight = this->extinction + OpticalTable<FourFloats>::colorFloor;
    this->ofIntegrals = wide ? perDistance / weight : 0.0f;
    this->ofValues = wide ? 0.0f : 0.5f;
  }
};

/// Transfer functions as rays read them, see OpticalTable.
class Classification
{
public:
  Classification() = default;
  explicit Classification(const TransferFunctions& functions);

  /// Numbers and addresses, which hold as long as this object stays where it is.
  OpticalTable<FourFloats> Table() const;

  float Majorant() const { return this->LargestExtinction; } ///< [1/length]
  bool Empty() const { return this->Values.empty(); }

  const std::vector<FourFloats>& Entries() const { return this->Values; }
  const std::vector<FourFloats>& IntegralsOfEntries() const { return this->Integrals; }
  const std::vector<float>& LargestOfEntries() const { return this->Maxima; }

private:
  float Low = 0;
  float Scale = 1;
  float LargestExtinction = 0;
  std::vector<FourFloats> Values; ///< see OpticalTable, like the others
  std::vector<FourFloats> Integrals;
  std::vector<float> Maxima;
};
}

#endif
