// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_math_Exp_h
#define limpid_math_Exp_h

#include "math/Macros.h"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace limpid
{
namespace detail
{
/// exp(-depth) = power (1 + growth) for 0 <= depth <= 87, by the method of Cody and Waite:
/// depth = k ln 2 - r, a polynomial in r, and k into the exponent bits. `growth` is as exact as a
/// float can be, and below ln(2) / 2 power is exactly 1.
struct ReducedExp
{
  float power;
  float growth;

  LIMPID_HD LIMPID_INLINE explicit ReducedExp(float depth)
  {
    constexpr float shift = 12582912.0f; // 1.5 * 2^23: adding it rounds to an integer
    const float k = (depth * -1.44269504088896341f + shift) - shift;
    float r = -depth - k * 0.693359375f;
    r = r + k * 2.12194440e-4f;
    float p = 1.9875691500e-4f;
    p = p * r + 1.3981999507e-3f;
    p = p * r + 8.3334519073e-3f;
    p = p * r + 4.1665795894e-2f;
    p = p * r + 1.6666665459e-1f;
    p = p * r + 5.0000001201e-1f;
    this->growth = p * (r * r) + r;
    const std::uint32_t bits = static_cast<std::uint32_t>(static_cast<std::int32_t>(k) + 127) << 23;
    std::memcpy(&this->power, &bits, sizeof(this->power));
  }
};

/// From here on exp(-depth) would leave the normal range of a float.
constexpr float deepest = 87.0f;
}

/// exp(-depth) for depth >= 0, in a form that compilers vectorise: exactly 1 at 0, monotone to
/// rounding, within 2 units in the last place, and exactly 0 from depth 87 on.
LIMPID_HD LIMPID_INLINE float Attenuate(float depth)
{
  const detail::ReducedExp parts(depth < detail::deepest ? depth : detail::deepest);
  return depth < detail::deepest ? (parts.growth + 1.0f) * parts.power : 0.0f;
}

LIMPID_HD LIMPID_INLINE double Attenuate(double depth)
{
  return std::exp(-depth);
}

/// 1 - exp(-depth) for depth >= 0, likewise; within 2 units in its own last place, however small.
LIMPID_HD LIMPID_INLINE float Stop(float depth)
{
  const detail::ReducedExp parts(depth < detail::deepest ? depth : detail::deepest);
  return (1.0f - parts.power) - parts.power * parts.growth;
}

LIMPID_HD LIMPID_INLINE double Stop(double depth)
{
  return -std::expm1(-depth);
}

/**
 * Natural logarithm of a normal number above zero, in a form that compilers vectorise; within 3
 * units in the last place of the larger of result and 1. Cody and Waite again: x = 2^k (1 + f).
 */
LIMPID_HD LIMPID_INLINE float Logarithm(float x)
{
  std::uint32_t bits;
  std::memcpy(&bits, &x, sizeof(bits));
  // So that 1 + f lies between the square roots of 1/2 and 2.
  const std::uint32_t shifted = bits - 0x3f3504f3u;
  const std::int32_t k = static_cast<std::int32_t>(shifted) >> 23;
  const std::uint32_t mantissa = (shifted & 0x007fffffu) + 0x3f3504f3u;
  float f;
  std::memcpy(&f, &mantissa, sizeof(f));
  f -= 1.0f;
  float p = 7.0376836292e-2f;
  p = p * f - 1.1514610310e-1f;
  p = p * f + 1.1676998740e-1f;
  p = p * f - 1.2420140846e-1f;
  p = p * f + 1.4249322787e-1f;
  p = p * f - 1.6668057665e-1f;
  p = p * f + 2.0000714765e-1f;
  p = p * f - 2.4999993993e-1f;
  p = p * f + 3.3333331174e-1f;
  const float square = f * f;
  const float tail = p * square * f - 0.5f * square;
  const float exponent = static_cast<float>(k);
  return (tail - exponent * 2.12194440e-4f) + f + exponent * 0.693359375f;
}
}

#endif
