// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_Interval_h
#define limpid_sweep_Interval_h

namespace limpid
{
/// Half-open range of columns; empty unless begin < end.
struct Interval
{
  int begin = 0;
  int end = 0;
  bool Empty() const { return this->begin >= this->end; }
};

/// Smallest interval that contains both.
inline Interval Hull(const Interval& a, const Interval& b)
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

/// Floats in a vector register.
constexpr int registerLanes = 8;

/// The interval made longer, to a whole number of vector registers, where `bounds`
/// have room for it: the rest of a row that does not fill a register would take as long as the row.
inline Interval FilledRegisters(const Interval& interval, const Interval& bounds)
{
  const int length =
    (interval.end - interval.begin + registerLanes - 1) / registerLanes * registerLanes;
  if (interval.Empty() || length > bounds.end - bounds.begin)
  {
    return interval;
  }
  const int begin = interval.end - length > bounds.begin ? interval.end - length : bounds.begin;
  return { begin, begin + length };
}

inline Interval Intersection(const Interval& a, const Interval& b)
{
  return { a.begin > b.begin ? a.begin : b.begin, a.end < b.end ? a.end : b.end };
}
}

#endif
