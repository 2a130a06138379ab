// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Sixteen numbers at a time in registers of the processor. For the processor alone.

#ifndef limpid_math_FloatLanes_h
#define limpid_math_FloatLanes_h

#include "math/Number.h"

namespace limpid
{
using EightFloats = float __attribute__((vector_size(32)));
using EightInts = std::int32_t __attribute__((vector_size(32)));

/// Sixteen integers of 32 bits.
struct IntLanes
{
  EightInts low;
  EightInts high;

  IntLanes() = default;
  LIMPID_INLINE IntLanes(const EightInts& lowLanes, const EightInts& highLanes)
    : low(lowLanes)
    , high(highLanes)
  {
  }
  // As two registers: GCC would copy both as one from memory, for which it must wait.
  LIMPID_INLINE IntLanes(const IntLanes& other)
    : low(other.low)
    , high(other.high)
  {
  }
  LIMPID_INLINE IntLanes& operator=(const IntLanes& other)
  {
    this->low = other.low;
    this->high = other.high;
    return *this;
  }

  LIMPID_INLINE void Store(std::int32_t* to) const
  {
    std::memcpy(to, &this->low, sizeof(this->low));
    std::memcpy(to + 8, &this->high, sizeof(this->high));
  }
};

/// In which of sixteen lanes a condition holds: all bits or none.
struct LaneMask
{
  EightInts low;
  EightInts high;
};

/// Sixteen floats. What is done to them is done to each, and gives the same as for a float alone.
/// Two registers of eight rather than one, so that one result need not wait for another.
struct FloatLanes
{
  static constexpr int count = 16;

  EightFloats low;
  EightFloats high;

  FloatLanes() = default;
  LIMPID_INLINE FloatLanes(float all)
  {
    // As a shuffle, which is one instruction; GCC inserts the numbers of a list one by one.
    const float __attribute__((vector_size(16))) one = { all };
    this->low = __builtin_shufflevector(one, one, 0, 0, 0, 0, 0, 0, 0, 0);
    this->high = this->low;
  }
  LIMPID_INLINE FloatLanes(const EightFloats& lowLanes, const EightFloats& highLanes)
    : low(lowLanes)
    , high(highLanes)
  {
  }
  LIMPID_INLINE FloatLanes(const FloatLanes& other)
    : low(other.low)
    , high(other.high)
  {
  }
  LIMPID_INLINE FloatLanes& operator=(const FloatLanes& other)
  {
    this->low = other.low;
    this->high = other.high;
    return *this;
  }

  LIMPID_INLINE void Store(float* to) const
  {
    std::memcpy(to, &this->low, sizeof(this->low));
    std::memcpy(to + 8, &this->high, sizeof(this->high));
  }
};

#define LIMPID_LANE_OPERATOR(Result, sign)                                                         \
  LIMPID_INLINE Result operator sign(const FloatLanes& a, const FloatLanes& b)                     \
  {                                                                                                \
    return Result{ a.low sign b.low, a.high sign b.high };                                         \
  }                                                                                                \
  LIMPID_INLINE Result operator sign(const FloatLanes& a, float b)                                 \
  {                                                                                                \
    return a sign FloatLanes(b);                                                                   \
  }                                                                                                \
  LIMPID_INLINE Result operator sign(float a, const FloatLanes& b)                                 \
  {                                                                                                \
    return FloatLanes(a) sign b;                                                                   \
  }
LIMPID_LANE_OPERATOR(FloatLanes, +)
LIMPID_LANE_OPERATOR(FloatLanes, -)
LIMPID_LANE_OPERATOR(FloatLanes, *)
LIMPID_LANE_OPERATOR(FloatLanes, /)
LIMPID_LANE_OPERATOR(LaneMask, <)
LIMPID_LANE_OPERATOR(LaneMask, >)
LIMPID_LANE_OPERATOR(LaneMask, !=)
#undef LIMPID_LANE_OPERATOR

#define LIMPID_LANE_OPERATOR(sign)                                                                 \
  LIMPID_INLINE IntLanes operator sign(const IntLanes& a, std::int32_t b)                          \
  {                                                                                                \
    return IntLanes{ a.low sign b, a.high sign b };                                                \
  }
LIMPID_LANE_OPERATOR(+)
LIMPID_LANE_OPERATOR(-)
LIMPID_LANE_OPERATOR(*)
LIMPID_LANE_OPERATOR(&)
LIMPID_LANE_OPERATOR(<<)
LIMPID_LANE_OPERATOR(>>)
#undef LIMPID_LANE_OPERATOR

LIMPID_INLINE IntLanes operator+(const IntLanes& a, const IntLanes& b)
{
  return IntLanes{ a.low + b.low, a.high + b.high };
}

LIMPID_INLINE FloatLanes operator-(const FloatLanes& a)
{
  return FloatLanes(-a.low, -a.high);
}

LIMPID_INLINE FloatLanes Select(
  const LaneMask& condition, const FloatLanes& one, const FloatLanes& other)
{
  return FloatLanes(condition.low ? one.low : other.low, condition.high ? one.high : other.high);
}

LIMPID_INLINE float LaneOf(const FloatLanes& x, int lane)
{
  return lane < 8 ? x.low[lane] : x.high[lane - 8];
}

LIMPID_INLINE bool AnyOf(const LaneMask& condition)
{
  using Words = std::int64_t __attribute__((vector_size(32)));
  const auto words = reinterpret_cast<Words>(condition.low | condition.high);
  return ((words[0] | words[1]) | (words[2] | words[3])) != 0;
}

LIMPID_INLINE FloatLanes SquareRoot(const FloatLanes& x)
{
  alignas(32) float numbers[FloatLanes::count];
  x.Store(numbers);
  for (float& number : numbers)
  {
    number = std::sqrt(number);
  }
  FloatLanes roots;
  std::memcpy(&roots.low, numbers, sizeof(roots.low));
  std::memcpy(&roots.high, numbers + 8, sizeof(roots.high));
  return roots;
}

LIMPID_INLINE IntLanes BitsOf(const FloatLanes& x)
{
  return IntLanes{ reinterpret_cast<EightInts>(x.low), reinterpret_cast<EightInts>(x.high) };
}

LIMPID_INLINE FloatLanes FromBits(const IntLanes& bits)
{
  return FloatLanes(
    reinterpret_cast<EightFloats>(bits.low), reinterpret_cast<EightFloats>(bits.high));
}

LIMPID_INLINE FloatLanes Magnitude(const FloatLanes& x)
{
  return FromBits(BitsOf(x) & 0x7fffffff);
}

LIMPID_INLINE IntLanes Truncate(const FloatLanes& x)
{
  return IntLanes{ __builtin_convertvector(x.low, EightInts),
    __builtin_convertvector(x.high, EightInts) };
}

LIMPID_INLINE FloatLanes ToFloat(const IntLanes& x)
{
  return FloatLanes(
    __builtin_convertvector(x.low, EightFloats), __builtin_convertvector(x.high, EightFloats));
}

LIMPID_INLINE IntLanes Smaller(const IntLanes& a, std::int32_t b)
{
  const EightInts other = b - EightInts{};
  return IntLanes{ a.low < other ? a.low : other, a.high < other ? a.high : other };
}
}

#endif
