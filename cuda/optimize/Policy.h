// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Policy_h
#define limpid_optimize_Policy_h

#include "optimize/Problem.h"

#include <memory>

namespace limpid
{
/// Policy sweeps (Documentation/Method.md): each iteration is one backward sweep that finds, slice
/// by slice, the best extinction given what lies behind. `start`: first iterate [1/length]; empty:
/// the base extinction. `warm` tells that it is near the optimum, so that its transmittance can be
/// trusted.
std::unique_ptr<Minimizer> MakePolicy(
  const Problem& problem, std::vector<float>&& start, bool warm);
}

#endif
