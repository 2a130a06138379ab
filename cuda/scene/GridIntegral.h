// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_GridIntegral_h
#define limpid_scene_GridIntegral_h

#include "scene/Grid.h"

namespace limpid
{
/// The integral over the box of the nodes of the product of two fields that are trilinear between
/// them: exact but for rounding, and the same for any number of threads. Both fields:
/// grid.NodeCount() values [a], [b]; the integral [a b length^3].
double IntegralOfProduct(const Grid& grid, const float* a, const float* b);
}

#endif
