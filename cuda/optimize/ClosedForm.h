// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_ClosedForm_h
#define limpid_optimize_ClosedForm_h

#include "methods/MethodScene.h"
#include "optimize/ProblemFields.h"

#include <memory>

namespace limpid
{
/// Returns a problem's scene for a method, as seen from the problem's source: light or camera.
template <class AnyDevice>
MethodScene<AnyDevice> SceneOf(const std::shared_ptr<AnyDevice>& device, const Problem& problem,
  const ProblemFields<AnyDevice>& fields)
{
  return { device, problem.grid, problem.occupancy.get(),
    problem.forLight ? problem.Light() : problem.Camera(), problem.settings.rayDensity,
    fields.base.Data(), fields.importance.Data(), problem.settings.ament, problem.forLight };
}

/// Computes the extinction of a method that needs one pass. `extinction`: on the device; in: the
/// base extinction, out: the result [1/length].
template <class AnyDevice>
void FindByMethod(const std::shared_ptr<AnyDevice>& device, const Problem& problem,
  const ProblemFields<AnyDevice>& fields, float* extinction);

/**
 * Wraps a method without iterations as a Minimizer. Its only iteration computes the method's
 * extinction and measures the energy of Eq. (21), which the method itself does not minimise.
 */
template <class AnyDevice>
std::unique_ptr<Minimizer> MakeClosedForm(
  std::shared_ptr<AnyDevice> device, const Problem& problem);
}

#endif
