// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "energy/Despeckle.h"

#include "backend/Simd.h"
#include "backend/SlidingRows.h"

#include <algorithm>
#include <array>

namespace limpid
{
namespace
{
constexpr int needed = 8;     // neighbours on either side for a value to stay
constexpr int lanes = 16;     // nodes per block
constexpr int rowsAround = 9; // the row itself and its neighbours
constexpr int ownRow = rowsAround / 2;

/// Rows padded by one node in front and `lanes` behind, so that whole blocks can be read.
using RowsAround = std::array<const float*, rowsAround>;

Index PaddedLength(int count)
{
  return Index(count) + 1 + lanes;
}

/// Copies a row and repeats its ends. Returns whether it has any nonzero value.
LIMPID_MULTIVERSION
bool Pad(const float* __restrict row, int count, float* __restrict padded)
{
  int other = 0;
  for (int x = 0; x < count; ++x)
  {
    padded[x + 1] = row[x];
    other |= row[x] != 0 ? 1 : 0;
  }
  padded[0] = row[0];
  for (int x = count + 1; x < count + 1 + lanes; ++x)
  {
    padded[x] = row[count - 1];
  }
  return other != 0;
}

/// Returns the larger or the smaller of two values.
template <bool larger>
LIMPID_INLINE float Outer(float a, float b)
{
  return larger == (a > b) ? a : b;
}

/// Finds the eighth largest or smallest neighbour of the nodes of a block.
template <bool largest>
LIMPID_INLINE void FindEighth(const RowsAround& rows, int x, float* __restrict eighth)
{
  constexpr float nothing = largest ? -1e30f : 1e30f;
  float sorted[needed][lanes];
  for (auto& values : sorted)
  {
    std::fill_n(values, lanes, nothing);
  }
  for (int r = 0; r < rowsAround; ++r)
  {
    for (int dx = 0; dx < 3; ++dx)
    {
      if (r == ownRow && dx == 1)
      {
        continue;
      }
      float rest[lanes];
      std::copy_n(rows[std::size_t(r)] + x + dx, lanes, rest);
      for (auto& values : sorted)
      {
        for (int i = 0; i < lanes; ++i)
        {
          const float outer = Outer<largest>(values[i], rest[i]);
          rest[i] = Outer<!largest>(values[i], rest[i]);
          values[i] = outer;
        }
      }
    }
  }
  std::copy_n(sorted[needed - 1], lanes, eighth);
}

LIMPID_MULTIVERSION
void DespeckleRow(
  const RowsAround& rows, const float* __restrict baseExtinction, int count, float* __restrict out)
{
  for (int x = 0; x < count; x += lanes)
  {
    const float* own = rows[ownRow] + x + 1;
    int asLarge[lanes] = {}; // number of such nodes, including the node itself
    int asSmall[lanes] = {};
    for (const float* row : rows)
    {
      for (int dx = 0; dx < 3; ++dx)
      {
        for (int i = 0; i < lanes; ++i)
        {
          const float value = row[x + dx + i];
          asLarge[i] += value >= own[i] ? 1 : 0;
          asSmall[i] += value <= own[i] ? 1 : 0;
        }
      }
    }
    float result[lanes];
    int tooLarge = 0;
    int tooSmall = 0;
    for (int i = 0; i < lanes; ++i)
    {
      result[i] = own[i];
      tooLarge |= asLarge[i] <= needed ? 1 : 0;
      tooSmall |= asSmall[i] <= needed ? 1 : 0;
    }
    float eighth[lanes];
    if (tooLarge)
    {
      FindEighth<true>(rows, x, eighth);
      for (int i = 0; i < lanes; ++i)
      {
        result[i] = std::min(result[i], eighth[i]);
      }
    }
    if (tooSmall)
    {
      FindEighth<false>(rows, x, eighth);
      for (int i = 0; i < lanes; ++i)
      {
        result[i] = std::max(result[i], eighth[i]);
      }
    }
    const int here = std::min(lanes, count - x);
    for (int i = 0; i < here; ++i)
    {
      const bool filled = (baseExtinction[x + i] > 0) | (own[i] > 0);
      out[x + i] = filled ? result[i] : 0.0f;
    }
  }
}

/// Despeckles rows of one slice, see ForSlidingRows.
class SliceRows
{
public:
  SliceRows(
    const Int3& nodes, const float* baseExtinction, const float* importance, float* out, int slice)
    : Nodes(nodes)
    , BaseExtinction(baseExtinction)
    , Importance(importance)
    , Out(out)
    , Slice(slice)
    , Memory(ThreadScratch(static_cast<std::size_t>(rowsAround * PaddedLength(nodes.x))))
  {
  }

  /// Pads a row of this slice and of its two neighbours.
  void Enter(int y)
  {
    for (int dz = -1; dz <= 1; ++dz)
    {
      const Index row = Index(std::clamp(this->Slice + dz, 0, this->Nodes.z - 1)) * this->Nodes.y +
        std::clamp(y, 0, this->Nodes.y - 1);
      const std::size_t place = PlaceOf(dz, y);
      this->Filled[place] = Pad(this->Importance + row * this->Nodes.x, this->Nodes.x,
        this->Memory + Index(place) * PaddedLength(this->Nodes.x));
    }
  }

  /// Rows with only zeros around them are not written.
  void Visit(int y) const
  {
    if (std::any_of(this->Filled.begin(), this->Filled.end(), [](bool filled) { return filled; }))
    {
      const Index first = (Index(this->Slice) * this->Nodes.y + y) * this->Nodes.x;
      DespeckleRow(this->Around(y), this->BaseExtinction + first, this->Nodes.x, this->Out + first);
    }
  }

private:
  RowsAround Around(int y) const
  {
    RowsAround rows{};
    std::size_t next = 0;
    for (int dz = -1; dz <= 1; ++dz)
    {
      for (int dy = -1; dy <= 1; ++dy)
      {
        rows[next] = this->Memory + Index(PlaceOf(dz, y + dy)) * PaddedLength(this->Nodes.x);
        ++next;
      }
    }
    return rows;
  }

  static std::size_t PlaceOf(int dz, int y)
  {
    const int place = 3 * (dz + 1) + PlaceOfRow(y);
    return static_cast<std::size_t>(place);
  }

  Int3 Nodes;
  const float* BaseExtinction;
  const float* Importance;
  float* Out;
  int Slice;
  float* Memory;
  std::array<bool, rowsAround> Filled{}; ///< whether the row has any nonzero value
};
}

void Despeckle(const Grid& grid, const float* baseExtinction, const float* importance, float* zeros)
{
  ForSlidingRows(grid.nodes.y, { 0, grid.nodes.z },
    [&](int slice) { return SliceRows(grid.nodes, baseExtinction, importance, zeros, slice); });
}
}
