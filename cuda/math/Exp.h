// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_math_Exp_h
#define limpid_math_Exp_h

#include "math/Number.h"

#include <cmath>
#include <cstdint>

namespace limpid
{
namespace detail
{
/// exp(-depth) = power (1 + growth) for 0 <= depth <= 87, by the method of Cody and Waite: depth =
/// k ln 2 - r, with a polynomial in r and k in the exponent bits. `growth` is as accurate as a
/// float can be. For depth below ln(2) / 2, power is exactly 1.
template <class Number>
struct ReducedExp
{
  Number power;
  Number growth;

  LIMPID_HD LIMPID_INLINE explicit ReducedExp(const Number& depth)
  {
    constexpr float shift = 12582912.0f; // 1.5 * 2^23: adding it rounds to an integer
    const Number k = (depth * -1.44269504088896341f + shift) - shift;
    Number r = -depth - k * 0.693359375f;
    r = r + k * 2.12194440e-4f;
    Number p = 1.9875691500e-4f * r + 1.3981999507e-3f;
    p = p * r + 8.3334519073e-3f;
    p = p * r + 4.1665795894e-2f;
    p = p * r + 1.6666665459e-1f;
    p = p * r + 5.0000001201e-1f;
    this->growth = p * (r * r) + r;
    this->power = FromBits((Truncate(k) + 127) << 23);
  }
};

/// For larger depths exp(-depth) would leave the normal range of a float.
constexpr float deepest = 87.0f;
}

/// Returns exp(-depth) for depth >= 0, in a form that compilers vectorise. It is exactly 1 at 0,
/// monotone up to rounding, within 2 units in the last place, and exactly 0 from depth 87 on.
template <class Number>
LIMPID_HD LIMPID_INLINE Number Attenuate(const Number& depth)
{
  const detail::ReducedExp<Number> parts(AtMost(depth, detail::deepest));
  return Select(depth < detail::deepest, (parts.growth + 1.0f) * parts.power, 0.0f);
}

LIMPID_HD LIMPID_INLINE double Attenuate(double depth)
{
  return std::exp(-depth);
}

/// Returns 1 - exp(-depth) for depth >= 0, vectorisable; within 2 units in the last place, even if
/// small.
template <class Number>
LIMPID_HD LIMPID_INLINE Number Stop(const Number& depth)
{
  const detail::ReducedExp<Number> parts(AtMost(depth, detail::deepest));
  return (1.0f - parts.power) - parts.power * parts.growth;
}

LIMPID_HD LIMPID_INLINE double Stop(double depth)
{
  return -std::expm1(-depth);
}

/**
 * Returns the natural logarithm of a positive normal number, in a form that compilers vectorise;
 * within 3 units in the last place of max(|result|, 1). Uses the method of Cody and Waite: x = 2^k
 * (1 + f).
 */
template <class Number>
LIMPID_HD LIMPID_INLINE Number Logarithm(const Number& x)
{
  // Then 1 + f is between the square roots of 1/2 and 2.
  const auto shifted = BitsOf(x) - 0x3f3504f3;
  const auto k = shifted >> 23;
  const Number f = FromBits((shifted & 0x007fffff) + 0x3f3504f3) - 1.0f;
  Number p = 7.0376836292e-2f * f - 1.1514610310e-1f;
  p = p * f + 1.1676998740e-1f;
  p = p * f - 1.2420140846e-1f;
  p = p * f + 1.4249322787e-1f;
  p = p * f - 1.6668057665e-1f;
  p = p * f + 2.0000714765e-1f;
  p = p * f - 2.4999993993e-1f;
  p = p * f + 3.3333331174e-1f;
  const Number square = f * f;
  const Number tail = p * square * f - 0.5f * square;
  const Number exponent = ToFloat(k);
  return (tail - exponent * 2.12194440e-4f) + f + exponent * 0.693359375f;
}
}

#endif
