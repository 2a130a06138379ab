// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_CellsAround_h
#define limpid_CellsAround_h

#include "vtkType.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace limpid
{
/// Calls visit(cell) for the up to eight cells around a point of an image, by their ids. `nodes`:
/// number of points along each axis; there is one cell across a flat axis.
template <class Visit>
void ForCellsAround(
  const std::array<int, 3>& nodes, const std::array<int, 3>& point, const Visit& visit)
{
  std::array<int, 3> cells;
  std::array<int, 3> first;
  std::array<int, 3> last;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    cells[axis] = std::max(nodes[axis] - 1, 1);
    first[axis] = std::max(point[axis] - 1, 0);
    last[axis] = std::min(point[axis], cells[axis] - 1);
  }
  for (int z = first[2]; z <= last[2]; ++z)
  {
    for (int y = first[1]; y <= last[1]; ++y)
    {
      for (int x = first[0]; x <= last[0]; ++x)
      {
        visit(x + cells[0] * (y + vtkIdType(cells[1]) * z));
      }
    }
  }
}
}

#endif
