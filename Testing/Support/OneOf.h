// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_OneOf_h
#define limpid_testing_OneOf_h

#include <algorithm>
#include <cstdlib>

namespace limpid
{
/// Of cases at random, one of so many is enough where each takes long, as under a sanitizer: what
/// LIMPID_ONE_OF says, else as usual.
inline int OneOf(int usually = 1)
{
  const char* said = std::getenv("LIMPID_ONE_OF");
  return said ? std::max(1, std::atoi(said)) : usually;
}
}

#endif
