// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_ExactSum_h
#define limpid_backend_ExactSum_h

#include <array>
#include <cstddef>
#include <cstdint>

namespace limpid
{
/**
 * A sum of numbers without any rounding but that of the result: the same bits in whatever order the
 * numbers come, and whoever adds which of them. Takes 2^31 numbers at least.
 *
 * A number is an integer times 2^-1074; the sum is that integer in digits of 32 bits, each in 64,
 * which leaves room for carries until somebody asks (the small superaccumulator of [Nea15]).
 */
class ExactSum
{
public:
  static constexpr std::size_t digitCount = 67;
  using Digits = std::array<std::int64_t, digitCount>; ///< least digit first, with carries

  /// A number that is not finite makes the result that, or not a number.
  void Add(double number);

  ExactSum& operator+=(const ExactSum& other);

  /// The double that is nearest to the sum; of two, the even one.
  double Value() const;

private:
  /// Integers that say all: sums of them are those of sums.
  struct Parts
  {
    Digits digits{};
    std::int64_t infinite[2] = { 0, 0 }; ///< how many numbers were infinite, above and below zero
    std::int64_t undefined = 0;          ///< how many were none
  };

  Parts Sum;
};
}

#endif
