// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Adam_h
#define limpid_optimize_Adam_h

#include "optimize/AdamLevel.h"

#include <memory>

namespace limpid
{
/// Makes a minimiser of the same problem that starts from a given extinction [1/length].
using SuccessorMaker = std::function<std::unique_ptr<Minimizer>(const std::vector<float>&)>;

/// The paper's solver (Section 3.5): projected Adam at quarter, half and full resolution.
/// `smoother`: makes the minimiser that smooths the result.
std::unique_ptr<Minimizer> MakeAdam(const Problem& problem, StartingExtinction&& start,
  const AdamLevelMaker& maker, const SuccessorMaker& smoother);
}

#endif
