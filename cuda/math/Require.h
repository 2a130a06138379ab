// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_math_Require_h
#define limpid_math_Require_h

#include <cassert>
#include <sstream>
#include <stdexcept>

namespace limpid
{
/// The user's data or settings cannot be worked with. The message reads
/// "what is wrong (why it matters). What to do." and contains the offending value.
class Error : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// A GPU cannot go on: its memory is full, or it has failed. The processor may do the same.
class DeviceError : public Error
{
public:
  using Error::Error;
};
}

/// Checks the user's data or settings; always on. Throws limpid::Error.
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

/// Checks the programmer; debug builds only.
#define LIMPID_EXPECT(condition) assert(condition)

#endif
