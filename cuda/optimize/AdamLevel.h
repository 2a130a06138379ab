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
/// Adam's state at one resolution, on any device. In distributed runs each process
/// passes and receives the extinction of its owned slab.
class AdamLevel
{
public:
  virtual ~AdamLevel() = default;

  /// Returns the score of the base extinction from the camera.
  virtual Score BaseScore() const = 0;

  /// Return the records of the current extinction, and of the base extinction if that is current.
  virtual IterationRecord Measure() = 0;
  virtual IterationRecord MeasureBase() = 0;

  /// Performs step number `count`, starting at 1, and returns the record of the new extinction.
  virtual IterationRecord Step(int count) = 0;

  /// The current extinction [1/length].
  virtual std::vector<float> Extinction() = 0;

  /// Saves the current extinction as the best one.
  virtual void KeepBest() = 0;

  virtual const std::vector<float>& Best() = 0;
  virtual std::vector<float> TakeBest() = 0;
};

/// Makes the level of a problem from a starting extinction. The problem must outlive the level.
using AdamLevelMaker =
  std::function<std::unique_ptr<AdamLevel>(const Problem&, const StartingExtinction&)>;

/// Makes the level on a device.
template <class AnyDevice>
std::unique_ptr<AdamLevel> MakeAdamLevel(const std::shared_ptr<AnyDevice>& device,
  const Problem& problem, const StartingExtinction& start);
}

#endif
