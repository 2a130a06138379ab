// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The fields that rays read, in the form in which they read them: everything
// that a sample needs of a node lies together.

#ifndef limpid_render_Fields_h
#define limpid_render_Fields_h

#include "render/Classification.h"
#include "render/RayLight.h"
#include "scene/Grid.h"

#include <vector>

namespace limpid
{
/// The scalars of a volume and the nodes where there are none.
struct ScalarField
{
  Grid grid;
  const float* values = nullptr; ///< finite
  std::vector<float> mended;     ///< the values, if some were not finite: those of a neighbour
  std::vector<float> filled;     ///< 0 at those nodes, 1 elsewhere; empty: all are filled

  ScalarField() = default;
  ScalarField(const Grid& nodes, const float* scalars);
};

/// Four numbers per node: the gradient of the base extinction over its largest
/// length [1], in world directions, and a zero.
struct GradientField
{
  std::vector<std::int16_t> packed;
};

/// Gradient of the transfer function's extinction at the nodes, central
/// differences.
GradientField PackGradient(const ScalarField& scalars, const Classification& classification);

/**
 * What optimisation and light add, four numbers per node of a grid over the
 * same box: the share of the transfer function's extinction that is kept [1],
 * the extinction that is added [majorant], the transmittance from the light
 * [1], and a zero.
 *
 * The extinction of a sample is kept * mu-bar(s) + added. At a node that is the
 * optimised extinction, and where nothing was changed it is the transfer
 * function's of the interpolated scalar. What was cleared is clear between the
 * nodes, too, whatever the transfer function does between their scalars: a
 * difference of extinctions would leave its thin layers standing.
 */
struct OverlayField
{
  Int3 nodes{ 0 };
  std::vector<std::int16_t> packed;
  bool changed = false;  ///< some change is not zero
  bool shadowed = false; ///< some transmittance is not one
};
} // namespace limpid

#endif
