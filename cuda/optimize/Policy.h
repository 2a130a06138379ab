// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Policy_h
#define limpid_optimize_Policy_h

#include "optimize/Problem.h"

#include <memory>

namespace limpid
{
/// Makes the policy method (Documentation/Method.md) for a problem, which must outlive it, from a
/// first iterate. `warm`: whether the transmittance of that iterate can be trusted.
template <class AnyDevice>
std::unique_ptr<Minimizer> MakePolicy(const std::shared_ptr<AnyDevice>& device,
  const Problem& problem, const StartingExtinction& start, bool warm);
}

#endif
