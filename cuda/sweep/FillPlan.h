// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_FillPlan_h
#define limpid_sweep_FillPlan_h

#include "scene/Occupancy.h"
#include "sweep/PlanOutline.h"

namespace limpid
{
/// Fills the tables of which OutlineSweep has made the outline.
void FillPlan(PlannedFrustum& frustum, const Occupancy& occupancy);
}

#endif
