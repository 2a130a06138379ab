// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Terms_h
#define limpid_optimize_Terms_h

#include "energy/VisibilityTerm.h"
#include "optimize/Problem.h"

#include <optional>

namespace limpid
{
/// What the terms of a problem see of an extinction; zero where there is no such term.
struct Seen
{
  Visible byCamera;
  Visible byLight;
};

/// Energy and score of an extinction with that F_p, which the terms have seen.
IterationRecord RecordOf(const Problem& problem, double regularization, const Seen& seen);

/// The visibility terms of a problem; a term of weight zero is not there and costs nothing.
struct Terms
{
  Terms() = default;
  explicit Terms(const Problem& problem);

  /// Energy and score of an extinction; leaves the optical depths of all rays in the terms.
  IterationRecord Measure(const Problem& problem, const float* extinction);

  /// Adds the weighted derivative of all terms to `gradient`, and measures along the way.
  IterationRecord AddGradient(
    const Problem& problem, const std::vector<float>& extinction, std::vector<float>& gradient);

  std::optional<VisibilityTerm> camera;
  std::optional<VisibilityTerm> light;
};
}

#endif
