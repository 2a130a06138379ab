// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Finds the structure that is seen at a place of a picture.

#ifndef limpid_PickedStructure_h
#define limpid_PickedStructure_h

#include "scene/Grid.h"
#include "scene/Structures.h"

namespace limpid
{
/// Returns the row of the structure that contributes most to the opacity of a ray between two
/// points; 0: none does visibly. `rows`: row of the structure of each node; `extinction`: of each
/// node [1/length]. Both are taken from the nearest node.
StructureRow PickedStructure(const Grid& grid, const StructureRow* rows, const float* extinction,
  const Vec3& begin, const Vec3& end);
}

#endif
