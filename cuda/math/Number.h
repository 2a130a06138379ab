// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Functions that formulas need besides arithmetic. A formula that uses them works for a single
// float or for several at once, see FloatLanes.

#ifndef limpid_math_Number_h
#define limpid_math_Number_h

#include "math/Macros.h"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace limpid
{
constexpr double pi = 3.14159265358979323846;

/// Returns condition ? one : other.
LIMPID_HD LIMPID_INLINE float Select(bool condition, float one, float other)
{
  return condition ? one : other;
}

LIMPID_HD LIMPID_INLINE double Select(bool condition, double one, double other)
{
  return condition ? one : other;
}

LIMPID_HD LIMPID_INLINE std::int32_t Select(bool condition, std::int32_t one, std::int32_t other)
{
  return condition ? one : other;
}

/// Returns the larger of `x` and `least`; `least` if `x` is NaN.
template <class Number, class Limit>
LIMPID_HD LIMPID_INLINE Number AtLeast(const Number& x, Limit least)
{
  return Select(x > least, x, least);
}

/// Returns the smaller of `x` and `most`; `most` if `x` is NaN.
template <class Number, class Limit>
LIMPID_HD LIMPID_INLINE Number AtMost(const Number& x, Limit most)
{
  return Select(x < most, x, most);
}

/// Returns `x` clamped to [least, most]; `least` if `x` is NaN.
template <class Number, class Least, class Most>
LIMPID_HD LIMPID_INLINE Number Clamp(const Number& x, Least least, Most most)
{
  return AtMost(AtLeast(x, least), most);
}

/// Returns one of several numbers; a single number is returned itself.
LIMPID_HD LIMPID_INLINE float LaneOf(float x, int)
{
  return x;
}

LIMPID_HD LIMPID_INLINE bool AnyOf(bool condition)
{
  return condition;
}

LIMPID_HD LIMPID_INLINE bool And(bool one, bool other)
{
  return one && other;
}

/// Returns from[index].
LIMPID_HD LIMPID_INLINE std::int32_t Gather(const std::uint8_t* from, std::int32_t index)
{
  return from[index];
}

/// Returns a / b. On a GPU it is within 2 units in the last place for b in [2^-126, 2^126] (CUDA
/// Programming Guide, intrinsic functions), and takes three instructions without a branch. On the
/// processor it is correctly rounded.
LIMPID_HD LIMPID_INLINE float Quotient(float a, float b)
{
#ifdef __CUDA_ARCH__
  return __fdividef(a, b);
#else
  return a / b;
#endif
}

LIMPID_HD LIMPID_INLINE double Quotient(double a, double b)
{
  return a / b;
}

constexpr float leastNormal = 1.17549435e-38f; ///< least positive number of full precision

/// Returns part / whole, at most 1, for non-negative numbers; 1 if both are 0. Smaller wholes count
/// as the least normal number: on a GPU the quotient of zero and a number below 2^-128 is NaN.
LIMPID_HD LIMPID_INLINE float FractionOf(float part, float whole)
{
  return part < whole ? Quotient(part, AtLeast(whole, leastNormal)) : 1.0f;
}

LIMPID_HD LIMPID_INLINE float SquareRoot(float x)
{
  return std::sqrt(x);
}

LIMPID_HD LIMPID_INLINE double SquareRoot(double x)
{
  return std::sqrt(x);
}

LIMPID_HD LIMPID_INLINE float Magnitude(float x)
{
  return std::abs(x);
}

/// Returns `x` rounded towards zero.
LIMPID_HD LIMPID_INLINE std::int32_t Truncate(float x)
{
  return static_cast<std::int32_t>(x);
}

LIMPID_HD LIMPID_INLINE float ToFloat(std::int32_t x)
{
  return static_cast<float>(x);
}

/// Return the 32 bits of a number as an integer, and the number from its bits.
LIMPID_HD LIMPID_INLINE std::int32_t BitsOf(float x)
{
  std::int32_t bits;
  std::memcpy(&bits, &x, sizeof(bits));
  return bits;
}

LIMPID_HD LIMPID_INLINE float FromBits(std::int32_t bits)
{
  float x;
  std::memcpy(&x, &bits, sizeof(x));
  return x;
}
}

#endif
