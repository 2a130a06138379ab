// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_ShadowVolume_h
#define limpid_render_ShadowVolume_h

#include "scene/Eye.h"
#include "scene/Grid.h"

#include <vector>

namespace limpid
{
/**
 * Transmittance T_L from a light to every node of a grid, Eq. 16, by one sweep front to back.
 *
 * `extinction`: grid.NodeCount() values >= 0 [1/length]; `rayDensity`: rays per voxel and axis,
 * see Settings. `transmittance` is made grid.NodeCount() long [0, 1]. Throws limpid::Error when the
 * light has no direction or position.
 */
void FillShadow(const Grid& grid, const float* extinction, const Light& light, double rayDensity,
  std::vector<float>& transmittance);
}

#endif
