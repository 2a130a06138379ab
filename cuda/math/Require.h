// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_math_Require_h
#define limpid_math_Require_h

#include <cassert>
#include <sstream>
#include <stdexcept>

namespace limpid
{
/// The user's data or settings are invalid. The message reads "what is wrong (why it matters).
/// What to do." and contains the offending value.
class Error : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// A GPU is out of memory or has failed. The same work may succeed on the processor.
class DeviceError : public Error
{
public:
  using Error::Error;
};
}

/// Checks the user's data or settings in all builds. Throws limpid::Error.
#define LIMPID_REQUIRE(condition, message)                                                         \
  do                                                                                               \
  {                                                                                                \
    if (!(condition))                                                                              \
    {                                                                                              \
      std::ostringstream limpidMessage;                                                            \
      limpidMessage << message;                                                                    \
      throw ::limpid::Error(limpidMessage.str());                                                  \
    }                                                                                              \
  } while (false)

/// Checks for programming errors, in debug builds only.
#define LIMPID_EXPECT(condition) assert(condition)

#endif
