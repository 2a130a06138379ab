// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_OneOf_h
#define limpid_testing_OneOf_h

#include <algorithm>
#include <cstdlib>

namespace limpid
{
/// Tests that take long, for example under a sanitizer, run one case out of this number, chosen at
/// random: the value of LIMPID_ONE_OF if set, else `usually`.
inline int OneOf(int usually = 1)
{
  const char* said = std::getenv("LIMPID_ONE_OF");
  return said ? std::max(1, std::atoi(said)) : usually;
}
}

#endif
