// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_Work_h
#define limpid_sweep_Work_h

#include "sweep/Plan.h"

namespace limpid
{
/// Fills in Slice::work, of every row of rays in every layer the columns that can matter, and
/// what they touch. All else of the frustum's slices has to be there.
void FindWork(FaceFrustum& frustum, const Occupancy& occupancy);
}

#endif
