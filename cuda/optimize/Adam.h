// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Adam_h
#define limpid_optimize_Adam_h

#include "optimize/AdamLevel.h"

#include <memory>

namespace limpid
{
/// The paper's solver (Section 3.5): projected Adam on a quarter, a half and the full resolution.
/// `start`: first iterate [1/length]; empty: the base extinction.
std::unique_ptr<Minimizer> MakeAdam(
  const Problem& problem, std::vector<float>&& start, const AdamLevelMaker& maker);
}

#endif
