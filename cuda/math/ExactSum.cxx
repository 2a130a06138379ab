// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "math/ExactSum.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace limpid
{
namespace
{
constexpr int bitsPerDigit = 32;
constexpr std::int64_t digitBase = std::int64_t(1) << bitsPerDigit;
constexpr int fractionBits = 52;
constexpr int leastExponent = -1074; ///< exponent of the last bit of a double

/// Normalises all digits but the last one to [0, base).
void Carry(ExactSum::Digits& digits)
{
  for (std::size_t i = 0; i + 1 < digits.size(); ++i)
  {
    const std::int64_t carry = digits[i] >> bitsPerDigit; // rounds down
    digits[i] -= carry * digitBase;
    digits[i + 1] += carry;
  }
}
}

void ExactSum::Add(double number)
{
  std::uint64_t bits;
  std::memcpy(&bits, &number, sizeof(bits));
  const auto exponent = static_cast<int>(bits >> fractionBits & 0x7ff);
  const std::uint64_t fraction = bits & ((std::uint64_t(1) << fractionBits) - 1);
  if (exponent == 0x7ff)
  {
    ++(std::isnan(number) ? this->Sum.undefined : this->Sum.infinite[std::signbit(number)]);
    return;
  }
  // Subnormal numbers have the smallest exponent and no leading 1.
  const std::uint64_t integer =
    exponent > 0 ? fraction | std::uint64_t(1) << fractionBits : fraction;
  const int shift = exponent > 0 ? exponent - 1 : 0;
  const int inDigit = shift % bitsPerDigit;
  const auto first = static_cast<std::size_t>(shift / bitsPerDigit);
  const std::uint64_t low = (integer & (digitBase - 1)) << inDigit;
  const std::uint64_t high = (integer >> bitsPerDigit) << inDigit; // at most 21 bits, shifted by
                                                                   // less than 32
  const std::uint64_t middle = (low >> bitsPerDigit) + (high & (digitBase - 1));
  const std::int64_t sign = std::signbit(number) ? -1 : 1;
  this->Sum.digits[first] += sign * static_cast<std::int64_t>(low & (digitBase - 1));
  this->Sum.digits[first + 1] += sign * static_cast<std::int64_t>(middle);
  this->Sum.digits[first + 2] += sign * static_cast<std::int64_t>(high >> bitsPerDigit);
}

ExactSum& ExactSum::operator+=(const ExactSum& other)
{
  for (std::size_t i = 0; i < digitCount; ++i)
  {
    this->Sum.digits[i] += other.Sum.digits[i];
  }
  this->Sum.infinite[0] += other.Sum.infinite[0];
  this->Sum.infinite[1] += other.Sum.infinite[1];
  this->Sum.undefined += other.Sum.undefined;
  return *this;
}

double ExactSum::Value() const
{
  const bool above = this->Sum.infinite[0] > 0;
  const bool below = this->Sum.infinite[1] > 0;
  if (this->Sum.undefined > 0 || (above && below))
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (above || below)
  {
    return above ? HUGE_VAL : -HUGE_VAL;
  }
  Digits digits = this->Sum.digits;
  Carry(digits);
  const bool negative = digits.back() < 0;
  if (negative)
  {
    for (std::int64_t& digit : digits)
    {
      digit = -digit;
    }
    Carry(digits);
  }
  std::size_t top = digits.size() - 1;
  while (top > 0 && digits[top] == 0)
  {
    --top;
  }
  const auto digitAt = [&digits, top](std::size_t behindTop)
  { return behindTop <= top ? static_cast<std::uint64_t>(digits[top - behindTop]) : 0; };
  // The 64 leading bits; the last one also represents all remaining bits. That is more than a
  // double holds, so the conversion rounds correctly.
  std::uint64_t leading = digitAt(0) << bitsPerDigit | digitAt(1);
  std::uint64_t behind = digitAt(2);
  int exponent = leastExponent + (static_cast<int>(top) - 1) * bitsPerDigit;
  for (; leading != 0 && leading >> 63 == 0; --exponent)
  {
    behind <<= 1;
    leading = leading << 1 | behind >> bitsPerDigit;
    behind &= digitBase - 1;
  }
  for (std::size_t rest = 3; rest <= top; ++rest)
  {
    behind |= digitAt(rest);
  }
  const double size = std::ldexp(static_cast<double>(leading | (behind != 0 ? 1 : 0)), exponent);
  return negative ? -size : size;
}
}
