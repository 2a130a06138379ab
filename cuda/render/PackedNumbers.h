// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_PackedNumbers_h
#define limpid_render_PackedNumbers_h

#include "backend/Simd.h"
#include "backend/WideLoad.h"
#include "math/Vec.h"

#include <cstdint>

namespace limpid
{
/// Largest absolute value of a packed number; it stands for 1.
constexpr float packedOne = 32767.0f;

/// Packed numbers of a node, see ExtinctionOverlay and PackedGradientNode.
template <int Count>
struct alignas(2 * Count) Packed
{
  std::int16_t values[Count];
};

using TwoPacked = Packed<2>;
using FourPacked = Packed<4>;

/// A small vector for devices, in place of the processor's register; it has the same layout in
/// memory.
template <int Count>
struct alignas(4 * Count) Floats
{
  float values[Count];

  LIMPID_HD LIMPID_INLINE float& operator[](int i) { return this->values[i]; }
  LIMPID_HD LIMPID_INLINE float operator[](int i) const { return this->values[i]; }
};

using FourFloats = Floats<4>;

template <int Count>
LIMPID_HD LIMPID_INLINE Floats<Count> operator+(const Floats<Count>& a, const Floats<Count>& b)
{
  Floats<Count> sum;
  for (int i = 0; i < Count; ++i)
  {
    sum[i] = a[i] + b[i];
  }
  return sum;
}

template <int Count>
LIMPID_HD LIMPID_INLINE Floats<Count> operator-(const Floats<Count>& a, const Floats<Count>& b)
{
  Floats<Count> difference;
  for (int i = 0; i < Count; ++i)
  {
    difference[i] = a[i] - b[i];
  }
  return difference;
}

template <int Count>
LIMPID_HD LIMPID_INLINE Floats<Count> operator*(float factor, const Floats<Count>& a)
{
  Floats<Count> product;
  for (int i = 0; i < Count; ++i)
  {
    product[i] = factor * a[i];
  }
  return product;
}

/// Convert packed numbers for arithmetic.
LIMPID_HD LIMPID_INLINE float Unpacked(float value)
{
  return value;
}

template <int Count>
LIMPID_HD LIMPID_INLINE Floats<Count> Unpacked(const Packed<Count>& packed)
{
  const Packed<Count> all = LoadAtOnce(packed);
  Floats<Count> numbers;
  for (int i = 0; i < Count; ++i)
  {
    numbers[i] = all.values[i];
  }
  return numbers;
}

/// Returns a + share (b - a), for numbers or registers.
template <class Value, class Share>
LIMPID_HD LIMPID_INLINE Value Blend(const Value& a, const Value& b, const Share& share)
{
  return a + share * (b - a);
}
}

#endif
