// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/FieldSlabs.h"

#include "sweep/CopiedSlabs.h"

#include <algorithm>

namespace limpid
{
namespace
{
constexpr int columnsPerTile = 16; // number of columns per tile, whose cache lines are reused

/// Rows of the fields themselves.
class SlabsInPlace : public FieldSlabs
{
public:
  explicit SlabsInPlace(const FaceFrustum& frustum)
    : FieldSlabs({ { 0, frustum.SliceCount() } })
    , Frustum(frustum)
  {
  }

  SliceWindow Open(float* field, const FieldUse& use) override
  {
    return { field, use, this->Frustum.nodesU, this->Frustum.nodesV, this->Frustum.strideV,
      this->Frustum.strideW, field };
  }

  void Load(const Range<int>&, const Occupancy*, Windows&) const override {}
  void Store(const Range<int>&, const Occupancy*, const Windows&) const override {}

private:
  FaceFrustum Frustum;
};

/// Copies with slices along x, columns along y and rows along z.
class TransposedSlabs : public CopiedSlabs
{
public:
  TransposedSlabs(const FaceFrustum& frustum, const BandDecomposition& bands)
    : CopiedSlabs(frustum, bands, 0)
  {
  }

  void Load(const Range<int>& slab, const Occupancy* occupancy, Windows& windows) const override
  {
    for (SliceWindow& window : windows)
    {
      const Box box = this->BoxRead(slab, window.use.inFront, window.use.behind);
      Move(window, box.nodes);
      this->ForFilledRows(box, occupancy,
        [&](int v, const Range<int>& columns)
        {
          window.memory->ClearRow(v, columns, box.nodes.Length());
          this->TransposeRow(window, v, columns, box.nodes);
        });
    }
  }

  void Store(
    const Range<int>& slab, const Occupancy* occupancy, const Windows& windows) const override
  {
    const Box box = this->BoxOwned(slab);
    for (const SliceWindow& window : windows)
    {
      if (window.use.writes)
      {
        this->ForFilledRows(box, occupancy,
          [&](int v, const Range<int>& columns)
          { this->TransposeBack(window, v, columns, box.nodes); });
      }
    }
  }

private:
  void TransposeRow(
    const SliceWindow& window, int v, const Range<int>& columns, const Range<int>& nodes) const
  {
    const float* source = window.field + this->Frustum.strideV * v + nodes.begin;
    float* target = window.Row(nodes.begin, v);
    for (int tile = columns.begin; tile < columns.end; tile += columnsPerTile)
    {
      const int last = std::min(tile + columnsPerTile, columns.end);
      for (int k = 0; k < nodes.Length(); ++k)
      {
        for (int u = tile; u < last; ++u)
        {
          target[k * window.strideW + u] = source[this->Frustum.strideU * u + k];
        }
      }
    }
  }

  void TransposeBack(
    const SliceWindow& window, int v, const Range<int>& columns, const Range<int>& nodes) const
  {
    float* target = window.field + this->Frustum.strideV * v + nodes.begin;
    const float* source = window.Row(nodes.begin, v);
    for (int u = columns.begin; u < columns.end; ++u)
    {
      for (int k = 0; k < nodes.Length(); ++k)
      {
        target[this->Frustum.strideU * u + k] = source[k * window.strideW + u];
      }
    }
  }
};
}

std::unique_ptr<FieldSlabs> FieldSlabs::Local(
  const FaceFrustum& frustum, const BandDecomposition& bands)
{
  if (frustum.axisW == 0)
  {
    return std::make_unique<TransposedSlabs>(frustum, bands);
  }
  return std::make_unique<SlabsInPlace>(frustum);
}
}
