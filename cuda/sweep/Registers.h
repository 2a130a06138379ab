// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_Registers_h
#define limpid_sweep_Registers_h

#include "math/Range.h"

namespace limpid
{
/// Number of floats in a vector register.
constexpr int registerLanes = 8;

/// Widens a range of columns to whole vector registers, if it fits into `bounds`. A partly filled
/// register would take as long as the whole row.
LIMPID_HD LIMPID_INLINE Range<int> WholeRegisters(
  const Range<int>& columns, const Range<int>& bounds)
{
  const int length = (columns.Length() + registerLanes - 1) / registerLanes * registerLanes;
  if (columns.Empty() || length > bounds.Length())
  {
    return columns;
  }
  const int begin = columns.end - length > bounds.begin ? columns.end - length : bounds.begin;
  return { begin, begin + length };
}
}

#endif
