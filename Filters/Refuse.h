// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_Refuse_h
#define limpid_Refuse_h

#include <sstream>
#include <stdexcept>

namespace limpid
{
/// The user's data or settings cannot be worked with: throws. The parts make up a message that
/// reads "what is wrong (why it matters). What to do." and contains the offending value.
template <class... Parts>
[[noreturn]] void Refuse(const Parts&... parts)
{
  std::ostringstream message;
  (message << ... << parts);
  throw std::invalid_argument(message.str());
}
}

#endif
