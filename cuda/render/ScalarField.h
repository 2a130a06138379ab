// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_ScalarField_h
#define limpid_render_ScalarField_h

#include "render/ScalarNodes.h"
#include "scene/Grid.h"

#include <vector>

namespace limpid
{
/// The scalars of a volume, with a mask of empty nodes.
struct ScalarField
{
  ScalarNodes values;        ///< finite
  std::vector<float> mended; ///< the values, if some were not finite: those are replaced by
                             ///< neighbours
  std::vector<float> filled; ///< 0 at those nodes, else the share that is kept; empty: all
                             ///< nodes are filled

  ScalarField() = default;
  ScalarField(const Grid& grid, const ScalarNodes& nodes, const float* shares);
};
}

#endif
