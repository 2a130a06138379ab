// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_Extent_h
#define limpid_backend_Extent_h

namespace limpid
{
/// The number of elements that a launch visits; empty if either number is 0.
struct Extent
{
  int columns = 0; ///< neighbouring columns are neighbouring threads in a warp
  int rows = 0;
};
}

#endif
