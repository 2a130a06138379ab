// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_test_PlanSweep_h
#define limpid_test_PlanSweep_h

#include "sweep/FillPlan.h"

#include <vector>

namespace limpid
{
/// Returns the plans of all frusta that cover a grid as seen from a source.
inline std::vector<PlannedFrustum> PlanSweep(const Grid& grid, const Occupancy& occupancy,
  const RaySource& source, const PlanSettings& settings)
{
  std::vector<PlannedFrustum> frusta = OutlineSweep(grid, source, settings);
  for (PlannedFrustum& frustum : frusta)
  {
    FillPlan(frustum, occupancy);
  }
  return frusta;
}
}

#endif
