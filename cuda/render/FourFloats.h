// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_FourFloats_h
#define limpid_render_FourFloats_h

#include "backend/Simd.h"
#include "math/Vec.h"

#include <cstdint>

namespace limpid
{
/// Largest absolute value of a packed number; it stands for 1.
constexpr float packedOne = 32767.0f;

/// Four packed numbers of a node, see ExtinctionOverlay and PackedGradientNode.
struct alignas(8) FourPacked
{
  std::int16_t values[4];
};

/// What a register of four floats is to the processor, for devices; laid out the same in memory.
struct alignas(16) FourFloats
{
  float values[4];

  LIMPID_HD LIMPID_INLINE float& operator[](int i) { return this->values[i]; }
  LIMPID_HD LIMPID_INLINE float operator[](int i) const { return this->values[i]; }
};

LIMPID_HD LIMPID_INLINE FourFloats operator+(const FourFloats& a, const FourFloats& b)
{
  return { { a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3] } };
}

LIMPID_HD LIMPID_INLINE FourFloats operator-(const FourFloats& a, const FourFloats& b)
{
  return { { a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3] } };
}

LIMPID_HD LIMPID_INLINE FourFloats operator*(float factor, const FourFloats& a)
{
  return { { factor * a[0], factor * a[1], factor * a[2], factor * a[3] } };
}

/// a + share (b - a), of numbers or registers.
template <class Value, class Share>
LIMPID_HD LIMPID_INLINE Value Blend(const Value& a, const Value& b, const Share& share)
{
  return a + share * (b - a);
}
}

#endif
