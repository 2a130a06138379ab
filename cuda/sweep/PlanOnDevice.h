// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Fills the plan of a sweep on a device. The formulas are those of the processor (FillPlan.h), and
// so are the results, bit for bit.

#ifndef limpid_sweep_PlanOnDevice_h
#define limpid_sweep_PlanOnDevice_h

#include "backend/DeviceArray.h"
#include "scene/Occupancy.h"
#include "sweep/PlanOutline.h"

#include <memory>

namespace limpid
{
/// FillPlan for tables in the memory of a device. Does not wait. `outline`: made by OutlineSweep;
/// `tables`: address of its tables on the device, where those of the outline are filled and the
/// others are 0. Frusta must not be banded.
template <class AnyDevice>
void FillPlanOnDevice(const std::shared_ptr<AnyDevice>& device, const PlannedFrustum& outline,
  const unsigned char* tables, const Occupancy& occupancy);
}

#endif
