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
/// The score of a set of rays and its derivative by movements of their eye.
struct ViewDerivative
{
  double score = 0;           ///< [length^2]
  double slope[2] = { 0, 0 }; ///< derivative by each move [length]
};

/// Sums what sets of rays see.
class ScoreSweep
{
public:
  virtual ~ScoreSweep() = default;

  /// Thread-safe. Consumes the parts.
  virtual Seen See(std::vector<ViewFields::Part>&& parts) const = 0;

  /// Computes the derivative by two moves of the eye (ViewDerivativeKernel.h), with layers divided
  /// into `cuts` parts. Thread-safe. Consumes the part.
  virtual ViewDerivative Differentiate(
    ViewFields::Part&& part, const EyeMoves& moves, int cuts) const = 0;
};

/// For parts of these fields, which must outlive the result.
template <class AnyDevice>
std::unique_ptr<ScoreSweep> MakeScoreSweep(
  std::shared_ptr<AnyDevice> device, const ViewFields& fields);
}

#endif
