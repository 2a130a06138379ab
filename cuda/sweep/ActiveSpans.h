// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_ActiveSpans_h
#define limpid_sweep_ActiveSpans_h

#include "scene/Occupancy.h"
#include "sweep/PlanOutline.h"

namespace limpid
{
/// Finds the columns of rays that can matter in every row and layer (FaceFrustum::activeRays), and
/// the voxels that these rays touch. All other ray tables must be filled already. So must the maps
/// from voxels to rays if the frustum has voxels.
void FindActiveSpans(PlannedFrustum& frustum, const Occupancy& occupancy);
}

#endif
