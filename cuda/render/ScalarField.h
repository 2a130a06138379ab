// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_ScalarField_h
#define limpid_render_ScalarField_h

#include "scene/Grid.h"

#include <vector>

namespace limpid
{
/// The scalars of a volume and the nodes where there are none.
struct ScalarField
{
  const float* values = nullptr; ///< finite
  std::vector<float> mended;     ///< the values, if some were not finite: those of a neighbour
  std::vector<float> filled;     ///< 0 at those nodes, else what is left; empty: all are filled

  ScalarField() = default;
  ScalarField(const Grid& grid, const float* scalars, const float* shares);
};
}

#endif
