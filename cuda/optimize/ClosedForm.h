// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_ClosedForm_h
#define limpid_optimize_ClosedForm_h

#include "methods/MethodScene.h"
#include "optimize/ProblemFields.h"

#include <memory>

namespace limpid
{
/// The scene of a problem for a method, as the problem's source sees it: the light or the camera.
template <class AnyDevice>
MethodScene<AnyDevice> SceneOf(const std::shared_ptr<AnyDevice>& device, const Problem& problem,
  const ProblemFields<AnyDevice>& fields)
{
  return { device, problem.grid, problem.occupancy.get(),
    problem.forLight ? problem.light : problem.camera, problem.settings.rayDensity,
    fields.base.Data(), fields.importance.Data(), problem.settings.ament, problem.forLight };
}

/// The extinction that a problem's method makes in one pass. `extinction`: on the device; in: the
/// base; out [1/length].
template <class AnyDevice>
void FindByMethod(const std::shared_ptr<AnyDevice>& device, const Problem& problem,
  const ProblemFields<AnyDevice>& fields, float* extinction);

/**
 * A method that does not iterate, in the place of one that does: its only iteration makes its
 * extinction and measures the energy of that, Eq. (21), which it knows nothing of.
 */
template <class AnyDevice>
std::unique_ptr<Minimizer> MakeClosedForm(
  std::shared_ptr<AnyDevice> device, const Problem& problem);
}

#endif
