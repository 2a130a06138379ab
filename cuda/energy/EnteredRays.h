// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_EnteredRays_h
#define limpid_energy_EnteredRays_h

#include "sweep/Plan.h"

namespace limpid
{
/// Rays, guards apart, that are in the box along one axis by the time they come to `depth`. They
/// are neighbours.
inline Interval Entered(const RayAxis& axis, float depth)
{
  int begin = 1;
  int end = axis.Count() - 1;
  while (begin < end && axis.entry[std::size_t(begin)] > depth)
  {
    ++begin;
  }
  while (begin < end && axis.entry[std::size_t(end) - 1] > depth)
  {
    --end;
  }
  return { begin, end };
}

/// Those of a station, along both axes.
struct EnteredRays
{
  Interval columns;
  Interval rows;
};
}

#endif
