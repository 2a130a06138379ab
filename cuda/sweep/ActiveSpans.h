// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_ActiveSpans_h
#define limpid_sweep_ActiveSpans_h

#include "sweep/PlanSweep.h"

namespace limpid
{
/// Finds the columns of every row of rays that can matter in every layer
/// (FaceFrustum::activeRays), and the voxels that they touch. All other tables of rays have to be
/// there, and the maps from voxels to rays if voxels read.
void FindActiveSpans(PlannedFrustum& frustum, const Occupancy& occupancy, Readers readers);
}

#endif
