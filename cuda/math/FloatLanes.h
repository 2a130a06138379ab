// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Sixteen numbers at a time in vector registers. For the processor only.

#ifndef limpid_math_FloatLanes_h
#define limpid_math_FloatLanes_h

#include "math/Number.h"

#include <type_traits>

namespace limpid
{
using EightFloats = float __attribute__((vector_size(32)));
using EightInts = std::int32_t __attribute__((vector_size(32)));

/// Sixteen 32-bit numbers. Operations apply to each number and give the same result as for a
/// single number. Two registers of eight hide latency better than one: their results are
/// independent.
template <class Number>
struct LanesOf
{
  using Register = std::conditional_t<std::is_same_v<Number, float>, EightFloats, EightInts>;
  static constexpr int count = 16;

  Register low;
  Register high;

  LanesOf() = default;
  LIMPID_INLINE LanesOf(Number all)
  {
    // A shuffle is one instruction; GCC would insert the numbers of a list one by one.
    const Register one = { all };
    this->low = __builtin_shufflevector(one, one, 0, 0, 0, 0, 0, 0, 0, 0);
    this->high = this->low;
  }
  LIMPID_INLINE LanesOf(const Register& lowLanes, const Register& highLanes)
    : low(lowLanes)
    , high(highLanes)
  {
  }
  // Copies two registers; GCC would copy both at once through memory, which stalls.
  LIMPID_INLINE LanesOf(const LanesOf& other)
    : low(other.low)
    , high(other.high)
  {
  }
  LIMPID_INLINE LanesOf& operator=(const LanesOf& other)
  {
    this->low = other.low;
    this->high = other.high;
    return *this;
  }

  LIMPID_INLINE static LanesOf Load(const Number* from)
  {
    LanesOf lanes;
    std::memcpy(&lanes.low, from, sizeof(lanes.low));
    std::memcpy(&lanes.high, from + 8, sizeof(lanes.high));
    return lanes;
  }

  LIMPID_INLINE void Store(Number* to) const
  {
    std::memcpy(to, &this->low, sizeof(this->low));
    std::memcpy(to + 8, &this->high, sizeof(this->high));
  }
};

using FloatLanes = LanesOf<float>;
/// A condition: all bits are set where it holds, none elsewhere.
using IntLanes = LanesOf<std::int32_t>;

#define LIMPID_LANE_OPERATOR(Result, Operands, Number, sign)                                       \
  LIMPID_INLINE Result operator sign(const Operands& a, const Operands& b)                         \
  {                                                                                                \
    return Result(a.low sign b.low, a.high sign b.high);                                           \
  }                                                                                                \
  LIMPID_INLINE Result operator sign(const Operands& a, Number b)                                  \
  {                                                                                                \
    return a sign Operands(b);                                                                     \
  }                                                                                                \
  LIMPID_INLINE Result operator sign(Number a, const Operands& b)                                  \
  {                                                                                                \
    return Operands(a) sign b;                                                                     \
  }
LIMPID_LANE_OPERATOR(FloatLanes, FloatLanes, float, +)
LIMPID_LANE_OPERATOR(FloatLanes, FloatLanes, float, -)
LIMPID_LANE_OPERATOR(FloatLanes, FloatLanes, float, *)
LIMPID_LANE_OPERATOR(FloatLanes, FloatLanes, float, /)
LIMPID_LANE_OPERATOR(IntLanes, FloatLanes, float, <)
LIMPID_LANE_OPERATOR(IntLanes, FloatLanes, float, >)
LIMPID_LANE_OPERATOR(IntLanes, FloatLanes, float, !=)
LIMPID_LANE_OPERATOR(IntLanes, IntLanes, std::int32_t, +)
LIMPID_LANE_OPERATOR(IntLanes, IntLanes, std::int32_t, -)
LIMPID_LANE_OPERATOR(IntLanes, IntLanes, std::int32_t, *)
LIMPID_LANE_OPERATOR(IntLanes, IntLanes, std::int32_t, &)
LIMPID_LANE_OPERATOR(IntLanes, IntLanes, std::int32_t, <)
LIMPID_LANE_OPERATOR(IntLanes, IntLanes, std::int32_t, >)
#undef LIMPID_LANE_OPERATOR

LIMPID_INLINE IntLanes operator<<(const IntLanes& a, int bits)
{
  return IntLanes(a.low << bits, a.high << bits);
}

LIMPID_INLINE IntLanes operator>>(const IntLanes& a, int bits)
{
  return IntLanes(a.low >> bits, a.high >> bits);
}

LIMPID_INLINE FloatLanes operator-(const FloatLanes& a)
{
  return FloatLanes(-a.low, -a.high);
}

LIMPID_INLINE FloatLanes Select(
  const IntLanes& condition, const FloatLanes& one, const FloatLanes& other)
{
  return FloatLanes(condition.low ? one.low : other.low, condition.high ? one.high : other.high);
}

LIMPID_INLINE IntLanes Select(const IntLanes& condition, const IntLanes& one, const IntLanes& other)
{
  return IntLanes(condition.low ? one.low : other.low, condition.high ? one.high : other.high);
}

LIMPID_INLINE float LaneOf(const FloatLanes& x, int lane)
{
  return lane < 8 ? x.low[lane] : x.high[lane - 8];
}

LIMPID_INLINE bool AnyOf(const IntLanes& condition)
{
  using Words = std::int64_t __attribute__((vector_size(32)));
  const auto words = reinterpret_cast<Words>(condition.low | condition.high);
  return ((words[0] | words[1]) | (words[2] | words[3])) != 0;
}

LIMPID_INLINE FloatLanes Quotient(const FloatLanes& a, const FloatLanes& b)
{
  return a / b;
}

LIMPID_INLINE IntLanes And(const IntLanes& one, const IntLanes& other)
{
  return one & other;
}

LIMPID_INLINE IntLanes Gather(const std::uint8_t* from, const IntLanes& index)
{
  alignas(32) std::int32_t numbers[IntLanes::count];
  index.Store(numbers);
  for (std::int32_t& number : numbers)
  {
    number = from[number];
  }
  return IntLanes::Load(numbers);
}

/// Without a loop: for that, GCC 12 writes the lanes to memory in two parts and reads them as one,
/// which has to wait until both are written.
LIMPID_INLINE FloatLanes SquareRoot(const FloatLanes& x)
{
  const EightFloats low = { std::sqrt(x.low[0]), std::sqrt(x.low[1]), std::sqrt(x.low[2]),
    std::sqrt(x.low[3]), std::sqrt(x.low[4]), std::sqrt(x.low[5]), std::sqrt(x.low[6]),
    std::sqrt(x.low[7]) };
  const EightFloats high = { std::sqrt(x.high[0]), std::sqrt(x.high[1]), std::sqrt(x.high[2]),
    std::sqrt(x.high[3]), std::sqrt(x.high[4]), std::sqrt(x.high[5]), std::sqrt(x.high[6]),
    std::sqrt(x.high[7]) };
  return FloatLanes(low, high);
}

LIMPID_INLINE IntLanes BitsOf(const FloatLanes& x)
{
  return IntLanes(reinterpret_cast<EightInts>(x.low), reinterpret_cast<EightInts>(x.high));
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
  return IntLanes(
    __builtin_convertvector(x.low, EightInts), __builtin_convertvector(x.high, EightInts));
}

LIMPID_INLINE FloatLanes ToFloat(const IntLanes& x)
{
  return FloatLanes(
    __builtin_convertvector(x.low, EightFloats), __builtin_convertvector(x.high, EightFloats));
}
}

#endif
