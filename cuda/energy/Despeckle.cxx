// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "energy/Despeckle.h"

#include "backend/Simd.h"
#include "backend/SlidingRows.h"
#include "math/FloatLanes.h"

#include <algorithm>
#include <array>

namespace limpid
{
namespace
{
constexpr int needed = 8;                // neighbours on either side for a value to stay
constexpr int lanes = FloatLanes::count; // nodes per block
constexpr int rowsAround = 9;            // the row itself and its neighbours
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

/// Calls visit(values) for the neighbours of the nodes of a block from `x` on.
template <class Visit>
LIMPID_INLINE void ForNeighbors(const RowsAround& rows, int x, const Visit& visit)
{
  for (int r = 0; r < rowsAround; ++r)
  {
    for (int dx = 0; dx < 3; ++dx)
    {
      if (r != ownRow || dx != 1)
      {
        visit(FloatLanes::Load(rows[std::size_t(r)] + x + dx));
      }
    }
  }
}

/// Returns the eighth largest or smallest neighbour of the nodes of a block.
template <bool largest>
LIMPID_INLINE FloatLanes FindEighth(const RowsAround& rows, int x)
{
  FloatLanes sorted[needed]; // outermost first
  for (FloatLanes& values : sorted)
  {
    values = largest ? -1e30f : 1e30f;
  }
  ForNeighbors(rows, x,
    [&sorted](const FloatLanes& neighbor) LIMPID_INLINE_LAMBDA
    {
      FloatLanes rest = neighbor;
      LIMPID_UNROLL(8)
      for (int n = 0; n < needed; ++n)
      {
        const FloatLanes kept = sorted[n];
        const IntLanes isLarger = kept > rest;
        sorted[n] = largest ? Select(isLarger, kept, rest) : Select(isLarger, rest, kept);
        rest = largest ? Select(isLarger, rest, kept) : Select(isLarger, kept, rest);
      }
    });
  return sorted[needed - 1];
}

LIMPID_MULTIVERSION
void DespeckleRow(
  const RowsAround& rows, const float* __restrict baseExtinction, int count, float* __restrict out)
{
  constexpr int neighbors = 26;
  for (int x = 0; x < count; x += lanes)
  {
    const FloatLanes own = FloatLanes::Load(rows[ownRow] + x + 1);
    IntLanes smaller = 0; // minus their number
    IntLanes larger = 0;
    ForNeighbors(rows, x,
      [&](const FloatLanes& neighbor) LIMPID_INLINE_LAMBDA
      {
        smaller = smaller + (neighbor < own);
        larger = larger + (neighbor > own);
      });
    FloatLanes result = own;
    if (AnyOf(smaller < needed - neighbors)) // fewer than `needed` are as large
    {
      const FloatLanes eighth = FindEighth<true>(rows, x);
      result = Select(eighth < result, eighth, result);
    }
    if (AnyOf(larger < needed - neighbors))
    {
      const FloatLanes eighth = FindEighth<false>(rows, x);
      result = Select(result < eighth, eighth, result);
    }
    float despeckled[lanes];
    result.Store(despeckled);
    const float* given = rows[ownRow] + x + 1;
    const int here = std::min(lanes, count - x);
    for (int i = 0; i < here; ++i)
    {
      const bool filled = (baseExtinction[x + i] > 0) | (given[i] > 0);
      out[x + i] = filled ? despeckled[i] : 0.0f;
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
