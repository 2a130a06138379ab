// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_AxisOrder_h
#define limpid_scene_AxisOrder_h

#include "scene/Eye.h"
#include "scene/Grid.h"

namespace limpid
{
/// Another order of a grid's axes in memory: first, second and third are these axes of the grid.
struct AxisOrder
{
  Int3 axes{ 0, 1, 2 };

  bool Changes() const { return this->axes != Int3(0, 1, 2); }

  /// The same nodes at the same places, their axes in this order.
  Grid Of(const Grid& grid) const;

  /// The same rays in the index space of that grid.
  Eye Of(const Eye& eye) const;
};

/// Copies a field on a grid to the other order, whole.
void Reorder(const Grid& grid, const AxisOrder& order, const float* field, float* reordered);

/// Copies it back.
void Restore(const Grid& grid, const AxisOrder& order, const float* reordered, float* field);
}

#endif
