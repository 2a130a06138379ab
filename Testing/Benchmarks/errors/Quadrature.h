// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What the rule of quadrature along a ray is worth: S by a simple scorer, rule by rule.

#ifndef limpid_testing_benchmarks_errors_Quadrature_h
#define limpid_testing_benchmarks_errors_Quadrature_h

#include "Effort.h"
#include "Results.h"
#include "Truth.h"

#include <vector>

namespace limpid::benchmark
{
std::vector<QuadratureResult> MeasureQuadratures(const Truth& truth, const Effort& effort);
}

#endif
