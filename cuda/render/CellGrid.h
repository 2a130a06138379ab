// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_CellGrid_h
#define limpid_render_CellGrid_h

#include "backend/Simd.h"
#include "math/Vec.h"

namespace limpid
{
/// A grid's nodes as trilinear interpolation reads them.
struct CellGrid
{
  float lastNode[3] = { 0, 0, 0 };
  float lastCell[3] = { 0, 0, 0 };
  Index stride[3] = { 1, 1, 1 };

  CellGrid() = default;
  explicit CellGrid(const Int3& nodes)
    : lastNode{ float(nodes.x - 1), float(nodes.y - 1), float(nodes.z - 1) }
    , lastCell{ float(nodes.x - 2), float(nodes.y - 2), float(nodes.z - 2) }
    , stride{ 1, nodes.x, Index(nodes.x) * nodes.y }
  {
  }

  /// Splits a coordinate into the node before and the fraction of a cell.
  LIMPID_HD LIMPID_INLINE Index Split(int axis, float position, float& fraction) const
  {
    float inside = position > 0.0f ? position : 0.0f;
    inside = inside < this->lastNode[axis] ? inside : this->lastNode[axis];
    const float limit = inside < this->lastCell[axis] ? inside : this->lastCell[axis];
    const int before = static_cast<int>(limit);
    fraction = inside - static_cast<float>(before);
    return before;
  }
};
}

#endif
