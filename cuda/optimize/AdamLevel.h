// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_AdamLevel_h
#define limpid_optimize_AdamLevel_h

#include "optimize/Problem.h"

#include <functional>
#include <memory>
#include <vector>

namespace limpid
{
/// Adam's state on one resolution, wherever it lives. Where ranks share the problem, each gives and
/// gets the extinction of its slab.
class AdamLevel
{
public:
  virtual ~AdamLevel() = default;

  /// What the camera sees of the base extinction.
  virtual Score BaseScore() const = 0;

  /// The record of the present extinction, and of the base extinction, if it is that.
  virtual IterationRecord Measure() = 0;
  virtual IterationRecord MeasureBase() = 0;

  /// Step number `count`, from 1 on, and the record of what it leads to.
  virtual IterationRecord Step(int count) = 0;

  /// The present extinction [1/length].
  virtual std::vector<float> Extinction() = 0;

  /// Remembers the present extinction as the best.
  virtual void KeepBest() = 0;

  virtual const std::vector<float>& Best() = 0;
  virtual std::vector<float> TakeBest() = 0;
};

/// Makes the level of a problem, which stays with the caller, from a first extinction.
using AdamLevelMaker =
  std::function<std::unique_ptr<AdamLevel>(const Problem&, const StartingExtinction&)>;

/// Makes it on a device.
template <class AnyDevice>
std::unique_ptr<AdamLevel> MakeAdamLevel(const std::shared_ptr<AnyDevice>& device,
  const Problem& problem, const StartingExtinction& start);
}

#endif
