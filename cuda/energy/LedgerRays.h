// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_LedgerRays_h
#define limpid_energy_LedgerRays_h

#include "scene/Structures.h"
#include "sweep/FaceFrustum.h"

#include <cstddef>
#include <vector>

namespace limpid
{
/// Rows of structures as numbers in [0, 1), which an importance may be, too. They are exact.
constexpr float perRow = 1.0f / 65536;
static_assert(sizeof(StructureRow) == 2, "there are not more rows");

inline float NumberOf(StructureRow row)
{
  return perRow * static_cast<float>(row);
}

LIMPID_INLINE StructureRow RowOf(float number)
{
  return static_cast<StructureRow>(number * (1 / perRow));
}

/// A structure that a ray has met.
struct MetStructure
{
  StructureRow row;
  double depth;   ///< front to back: optical depth of it from the entry on
  float mostSeen; ///< back to front: the most that can be seen of it behind, times scale^2
};

/// What a ray has met.
struct LedgerRay
{
  double since = 0; ///< optical depth where it came into the structure that it is in
  std::vector<MetStructure> met{};

  MetStructure& Meet(StructureRow row)
  {
    for (MetStructure& one : this->met)
    {
      if (one.row == row)
      {
        return one;
      }
    }
    if (this->met.empty())
    {
      this->met.reserve(8);
    }
    this->met.push_back({ row, 0, 0 });
    return this->met.back();
  }
};

/// What the rays of a frustum remember between layers, besides their channels.
struct LedgerRays
{
  static constexpr float several = -1;

  std::vector<LedgerRay> all;
  std::vector<float> in;             ///< number of the row of the structure that each is in
  std::vector<float> hiddenPerDepth; ///< see LedgerStep
  std::vector<double> weights;       ///< by which what it sees is multiplied; 0: it does not count

  explicit LedgerRays(const FaceFrustum& frustum)
    : all(std::size_t(frustum.RayCount()))
    , in(this->all.size(), several)
    , hiddenPerDepth(this->all.size())
    , weights(this->all.size())
  {
    for (int row = 0; row < frustum.rows; ++row)
    {
      const Range<int>& columns = frustum.ColumnsOf(row);
      for (int column = columns.begin; column < columns.end; ++column)
      {
        const double share = frustum.cellMeasure *
          double(frustum.Row(frustum.columnShare)[column]) *
          double(frustum.Row(frustum.rowShare)[row]);
        if (share > 0 && (frustum.seesAll || frustum.OfRow(frustum.inView, row)[column] > 0))
        {
          this->weights[std::size_t(frustum.RayAt(column, row))] =
            share / double(frustum.OfRow(frustum.length, row)[column]);
        }
      }
    }
  }
};
}

#endif
