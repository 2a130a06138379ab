// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_EnteredRays_h
#define limpid_energy_EnteredRays_h

#include "sweep/Plan.h"

namespace limpid
{
/// RaysEnteredBy of a slice, along both axes.
struct EnteredRays
{
  Range<int> columns;
  Range<int> rows;
};
}

#endif
