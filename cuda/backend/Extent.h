// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_Extent_h
#define limpid_backend_Extent_h

namespace limpid
{
/// How many elements a launch visits; none if one of the numbers is 0.
struct Extent
{
  int columns = 0; ///< neighbours here are neighbours in a warp
  int rows = 0;
};
}

#endif
