// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Trilinear interpolation in a grid.

#ifndef limpid_render_Trilinear_h
#define limpid_render_Trilinear_h

#include "render/FourFloats.h"

namespace limpid
{
/// A grid's nodes as trilinear interpolation reads them.
struct CellGrid
{
  float lastNode[3] = { 0, 0, 0 };
  float lastCell[3] = { 0, 0, 0 };
  Index stride[3] = { 1, 1, 1 };
  int rows = 1; ///< of a slice

  CellGrid() = default;
  explicit CellGrid(const Int3& nodes)
    : lastNode{ float(nodes.x - 1), float(nodes.y - 1), float(nodes.z - 1) }
    , lastCell{ float(nodes.x - 2), float(nodes.y - 2), float(nodes.z - 2) }
    , stride{ 1, nodes.x, Index(nodes.x) * nodes.y }
    , rows(nodes.y)
  {
  }

  /// Splits a coordinate into the node before and the fraction of a cell.
  LIMPID_HD LIMPID_INLINE int Split(int axis, float position, float& fraction) const
  {
    float inside = position > 0.0f ? position : 0.0f;
    inside = inside < this->lastNode[axis] ? inside : this->lastNode[axis];
    const float limit = inside < this->lastCell[axis] ? inside : this->lastCell[axis];
    const int before = static_cast<int>(limit);
    fraction = inside - static_cast<float>(before);
    return before;
  }

  /// The first node of a cell. Vector units multiply numbers of 32 bits only.
  LIMPID_HD LIMPID_INLINE Index First(int x, int y, int z) const
  {
    const auto row = static_cast<std::uint32_t>(y + this->rows * z);
    const auto nodes = static_cast<std::uint32_t>(this->stride[1]);
    return x + static_cast<Index>(std::uint64_t(row) * nodes);
  }
};

/// A position in a grid.
struct CellPlace
{
  float fraction[3];
  Index cell; ///< first node of the cell

  /// `position`: [nodes]
  LIMPID_HD LIMPID_INLINE CellPlace(const CellGrid& grid, const float* position)
    : cell(grid.First(grid.Split(0, position[0], this->fraction[0]),
        grid.Split(1, position[1], this->fraction[1]),
        grid.Split(2, position[2], this->fraction[2])))
  {
  }
};

namespace detail
{
LIMPID_HD LIMPID_INLINE float Unpacked(float value)
{
  return value;
}

LIMPID_HD LIMPID_INLINE FourFloats Unpacked(const FourPacked& packed)
{
  const std::int16_t* values = packed.values;
  return { { float(values[0]), float(values[1]), float(values[2]), float(values[3]) } };
}

/// Blends along z, y and x.
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

/// Reads the samples of a ray one by one, number by number: for devices. BlockSampler does the same
/// in the same order of operations with the registers of the processor.
struct SingleSampler
{
  using Optical = FourFloats;
  static constexpr int segments = 1; ///< of a ray at a time

  /// Interpolates a field. `first`: at the first node of the cell; x, y, z: fractions of the cell.
  LIMPID_HD static LIMPID_INLINE float Interpolate(
    const CellGrid& grid, const float* first, float x, float y, float z)
  {
    return detail::InCell(grid, first, x, y, z);
  }

  /// Interpolates four packed numbers per node [packedOne].
  LIMPID_HD static LIMPID_INLINE FourFloats Interpolate(
    const CellGrid& grid, const FourPacked* first, float x, float y, float z)
  {
    return detail::InCell(grid, first, x, y, z);
  }

  /// Interpolates a field of either kind at samples from Begin to End - 1.
  template <int Begin, int End, class Node, class Value>
  LIMPID_HD static LIMPID_INLINE void InterpolateAll(const CellGrid& grid, const Node* field,
    const Index* cells, const float* x, const float* y, const float* z, Value* out)
  {
    for (int i = Begin; i < End; ++i)
    {
      out[i] = Interpolate(grid, field + cells[i], x[i], y[i], z[i]);
    }
  }
};
}

#endif
