// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_math_Range_h
#define limpid_math_Range_h

#include "math/Macros.h"

namespace limpid
{
/// A range from begin to end: half-open for integers, and empty unless begin < end. A GPU reads
/// both at once.
template <class Value>
struct alignas(2 * sizeof(Value)) Range
{
  Value begin = 0;
  Value end = 0;

  LIMPID_HD LIMPID_INLINE bool Empty() const { return !(this->begin < this->end); }
  LIMPID_HD LIMPID_INLINE Value Length() const { return this->end - this->begin; }
  LIMPID_HD LIMPID_INLINE bool Contains(Value value) const
  {
    return value >= this->begin && value < this->end;
  }

  LIMPID_HD friend LIMPID_INLINE Range Intersection(const Range& a, const Range& b)
  {
    return { a.begin > b.begin ? a.begin : b.begin, a.end < b.end ? a.end : b.end };
  }

  /// The smallest range that contains both.
  LIMPID_HD friend LIMPID_INLINE Range Hull(const Range& a, const Range& b)
  {
    if (a.Empty())
    {
      return b;
    }
    if (b.Empty())
    {
      return a;
    }
    return { a.begin < b.begin ? a.begin : b.begin, a.end > b.end ? a.end : b.end };
  }
};

/// Returns a range widened by `more` on either side, within [0, end); an empty range is unchanged.
LIMPID_HD LIMPID_INLINE Range<int> Grown(const Range<int>& range, int more, int end)
{
  return range.Empty()
    ? range
    : Intersection(Range<int>{ range.begin - more, range.end + more }, Range<int>{ 0, end });
}
}

#endif
