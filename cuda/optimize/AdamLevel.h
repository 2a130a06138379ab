// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_AdamLevel_h
#define limpid_optimize_AdamLevel_h

#include "optimize/AdamVoxel.h"
#include "optimize/Problem.h"

#include <functional>
#include <memory>
#include <vector>

namespace limpid
{
/// Adam's state on one resolution, wherever it lives.
class AdamLevel
{
public:
  virtual ~AdamLevel() = default;

  /// The record of the present extinction.
  virtual IterationRecord Measure() = 0;

  /// Step number `count`, from 1 on, and the record of what it leads to.
  virtual IterationRecord Step(int count) = 0;

  /// The present extinction [1/length].
  virtual std::vector<float> Extinction() = 0;

  /// Remembers the present extinction as the best.
  virtual void KeepBest() = 0;

  virtual const std::vector<float>& Best() = 0;
  virtual std::vector<float> TakeBest() = 0;
};

/// Makes the level of a problem, which stays with the caller, from a first extinction [1/length].
using AdamLevelMaker =
  std::function<std::unique_ptr<AdamLevel>(const Problem&, std::vector<float>&&)>;

/// What step number `count` does at every voxel; the arrays are left open.
AdamVoxel<float> AdamStep(const Problem& problem, int count);

/// On the processor.
std::unique_ptr<AdamLevel> MakeAdamLevel(const Problem& problem, std::vector<float>&& start);
}

#endif
