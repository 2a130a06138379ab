// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_Registers_h
#define limpid_sweep_Registers_h

#include "math/Range.h"

namespace limpid
{
/// Floats in a vector register.
constexpr int registerLanes = 8;

/// The columns and so many more that they fill whole vector registers, where `bounds` have room for
/// them: the rest of a row that does not fill a register would take as long as the row.
inline Range<int> WholeRegisters(const Range<int>& columns, const Range<int>& bounds)
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
