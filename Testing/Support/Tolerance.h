// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A tolerance is a bound with its reason: a failing test prints both.

#ifndef limpid_testing_Tolerance_h
#define limpid_testing_Tolerance_h

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace limpid
{
/// By how much a number may miss its expected value, and why.
struct Tolerance
{
  double value = 0;
  std::string reason;
};

/// Two independent errors may add up.
inline Tolerance operator+(const Tolerance& one, const Tolerance& other)
{
  return { one.value + other.value, one.reason + ", and " + other.reason };
}

/// Rounding of `operations` operations in Real whose results do not exceed `magnitude`.
template <class Real>
Tolerance Roundoff(double operations, double magnitude)
{
  const double unit = 0.5 * static_cast<double>(std::numeric_limits<Real>::epsilon());
  return { operations * unit * std::abs(magnitude),
    "rounding of " + std::to_string(operations) + " operations of magnitude " +
      std::to_string(magnitude) };
}

/// A bound relative to the expected value.
inline Tolerance Relative(double share, double expected, const std::string& reason)
{
  return { share * std::abs(expected), reason };
}

/// The predicate behind EXPECT_WITHIN. NaN is never within.
inline ::testing::AssertionResult IsWithin(const char* actualText, const char* expectedText,
  const char*, double actual, double expected, const Tolerance& tolerance)
{
  const double error = std::abs(actual - expected);
  if (error <= tolerance.value)
  {
    return ::testing::AssertionSuccess();
  }
  ::testing::AssertionResult failure = ::testing::AssertionFailure();
  failure.operator<<(actualText) << " is " << ::testing::PrintToString(actual) << ", expected "
                                 << ::testing::PrintToString(expected) << " (" << expectedText
                                 << "): off by " << error << ", allowed " << tolerance.value << " ("
                                 << tolerance.reason << ")";
  return failure;
}
}

#define EXPECT_WITHIN(actual, expected, tolerance)                                                 \
  EXPECT_PRED_FORMAT3(::limpid::IsWithin, actual, expected, tolerance)
#define ASSERT_WITHIN(actual, expected, tolerance)                                                 \
  ASSERT_PRED_FORMAT3(::limpid::IsWithin, actual, expected, tolerance)

#endif
