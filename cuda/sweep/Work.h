// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_Work_h
#define limpid_sweep_Work_h

#include "sweep/Plan.h"

namespace limpid
{
/// Fills in Station::work: of every row of rays in every layer, the columns that can matter. `u`
/// and `v`: the rays along the pyramid's lateral axes.
void FindWork(Pyramid& pyramid, const Occupancy& occupancy, const Lateral& u, const Lateral& v);
}

#endif
