// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Trilinear interpolation in a grid.

#ifndef limpid_render_Trilinear_h
#define limpid_render_Trilinear_h

#include "math/Number.h"
#include "render/PackedNumbers.h"

namespace limpid
{
/// The nodes of a grid in the form for trilinear interpolation.
struct CellGrid
{
  float lastNode[3] = { 0, 0, 0 };
  float lastCell[3] = { 0, 0, 0 };
  Index stride[3] = { 1, 1, 1 };
  int rows = 1; ///< rows per slice

  CellGrid() = default;
  explicit CellGrid(const Int3& nodes)
    : lastNode{ float(nodes.x - 1), float(nodes.y - 1), float(nodes.z - 1) }
    , lastCell{ float(nodes.x - 2), float(nodes.y - 2), float(nodes.z - 2) }
    , stride{ 1, nodes.x, Index(nodes.x) * nodes.y }
    , rows(nodes.y)
  {
  }

  /// Splits a coordinate into the node before it and the fraction of a cell.
  template <class Number>
  LIMPID_HD LIMPID_INLINE auto Split(int axis, const Number& position, Number& fraction) const
  {
    const Number inside = Clamp(position, 0.0f, this->lastNode[axis]);
    const auto before = Truncate(AtMost(inside, this->lastCell[axis]));
    fraction = inside - ToFloat(before);
    return before;
  }

  /// Returns the first node of a cell. Vector units multiply only 32-bit numbers.
  LIMPID_HD LIMPID_INLINE Index First(int x, int y, int z) const
  {
    const auto row = static_cast<std::uint32_t>(y + this->rows * z);
    const auto nodes = static_cast<std::uint32_t>(this->stride[1]);
    return x + static_cast<Index>(std::uint64_t(row) * nodes);
  }
};

/// Positions in a grid, as many as AnySampler processes at a time.
template <class AnySampler>
struct CellPlaces
{
  using Lanes = typename AnySampler::Lanes;

  Lanes fraction[3];                       ///< of the cell
  typename AnySampler::Integers before[3]; ///< index of the node before, along each axis
  typename AnySampler::Cells cell;         ///< first node of the cell

  CellPlaces() = default;

  /// `position`: [nodes]
  LIMPID_HD LIMPID_INLINE CellPlaces(const CellGrid& grid, const Lanes* position)
  {
    this->Set(grid, position);
  }

  LIMPID_HD LIMPID_INLINE void Set(const CellGrid& grid, const Lanes* position)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->before[axis] = grid.Split(axis, position[axis], this->fraction[axis]);
    }
    AnySampler::FindFirst(grid, this->before, this->cell);
  }
};

/// Interpolates between the nodes of a cell along z, y and x. `first`: its first node; x, y, z:
/// fractions of the cell.
template <class Node>
LIMPID_HD LIMPID_INLINE auto InCell(
  const CellGrid& grid, const Node* first, float x, float y, float z)
{
  const Index row = grid.stride[1];
  const Index slice = grid.stride[2];
  const auto along = [&](const Node* front)
  { return Blend(Unpacked(front[0]), Unpacked(front[slice]), z); };
  const auto near = Blend(along(first), along(first + row), y);
  const auto far = Blend(along(first + 1), along(first + 1 + row), y);
  return Blend(near, far, x);
}
}

#endif
