// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_ScoreSweep_h
#define limpid_viewpoint_ScoreSweep_h

#include "backend/CompiledDevice.h"
#include "energy/Score.h"
#include "viewpoint/ViewDerivativePlan.h"
#include "viewpoint/ViewFields.h"

#include <memory>
#include <vector>

namespace limpid
{
/// The score of a family of rays and how it changes when their eye moves.
struct ViewDerivative
{
  double score = 0;           ///< [length^2]
  double slope[2] = { 0, 0 }; ///< by either move [length]
};

/// Sums up what families of rays see.
class ScoreSweep
{
public:
  virtual ~ScoreSweep() = default;

  /// May be called by several threads. The parts are used up.
  virtual Seen See(std::vector<ViewFields::Part>&& parts) const = 0;

  /// Follows two moves of the eye (ViewDerivativeKernel.h), with layers cut into `cuts` parts. May
  /// be called by several threads. The part is used up.
  virtual ViewDerivative Differentiate(
    ViewFields::Part&& part, const EyeMoves& moves, int cuts) const = 0;
};

/// For parts of these fields, which stay with the caller.
template <class AnyDevice>
std::unique_ptr<ScoreSweep> MakeScoreSweep(
  std::shared_ptr<AnyDevice> device, const ViewFields& fields);
}

#endif
