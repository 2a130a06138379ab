// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_math_ExactSum_h
#define limpid_math_ExactSum_h

#include <array>
#include <cstddef>
#include <cstdint>

namespace limpid
{
/**
 * An exact sum, rounded only in the result. The bits of the result do not depend on the order of
 * the numbers or on how they are distributed. At least 2^31 numbers can be added.
 *
 * A number is an integer times 2^-1074. The sum is this integer in digits of 32 bits, each stored
 * in 64 bits, which defers carries until the result is requested (the small superaccumulator of
 * [Nea15]).
 */
class ExactSum
{
public:
  static constexpr std::size_t digitCount = 67;
  using Digits = std::array<std::int64_t, digitCount>; ///< least digit first, with carries

  /// Adds a number. Infinity or NaN makes the result infinite or NaN.
  void Add(double number);

  ExactSum& operator+=(const ExactSum& other);

  /// Returns the double nearest to the sum; ties to even.
  double Value() const;

private:
  /// All state as integers: adding these integers adds the sums.
  struct Parts
  {
    Digits digits{};
    std::int64_t infinite[2] = { 0, 0 }; ///< counts of positive and of negative infinity
    std::int64_t undefined = 0;          ///< count of NaN
  };

  Parts Sum;
};
}

#endif
