// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The paper's perspective grids (Testing/PaperScheme), coarse to fine: errors and time.

#ifndef limpid_testing_benchmarks_errors_Grids_h
#define limpid_testing_benchmarks_errors_Grids_h

#include "Effort.h"
#include "Results.h"
#include "Truth.h"

#include <vector>

namespace limpid::benchmark
{
/// From coarse grids to the finest that fit into the memory and the time that the options allow.
std::vector<GridResult> MeasureGrids(
  const Truth& truth, const Effort& effort, const Options& options);
}

#endif
