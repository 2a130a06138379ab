// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/FieldSlabs.h"

#include "sweep/CopiedSlabs.h"
#include "sweep/MadeFields.h"

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
      this->Transpose(this->InPlace(window), slab, occupancy, window);
    }
  }

  void Store(
    const Range<int>& slab, const Occupancy* occupancy, const Windows& windows) const override
  {
    const Box box = this->BoxOwned(slab);
    for (const SliceWindow& window : windows)
    {
      if (window.use.writes && window.memory)
      {
        this->ForFilledRows(box, occupancy,
          [&](int v, const Range<int>& columns)
          { this->TransposeBack(window, v, columns, box.nodes); });
      }
    }
  }

protected:
  /// Returns the view of the field of a window, if the depth is along x.
  FieldView InPlace(const SliceWindow& window) const
  {
    return { window.field, { { 1, this->Frustum.strideU, this->Frustum.strideV } } };
  }

  /// Copies what a sweep reads of a field to its window.
  void Transpose(const FieldView& field, const Range<int>& slab, const Occupancy* occupancy,
    SliceWindow& window) const
  {
    const Box box = this->BoxRead(slab, window.use.inFront, window.use.behind);
    Move(window, box.nodes);
    this->ForFilledRows(box, occupancy,
      [&](int v, const Range<int>& columns)
      {
        window.memory->ClearRow(v, columns, box.nodes.Length());
        TransposeRow(field, window, v, columns, box.nodes);
      });
  }

private:
  static void TransposeRow(const FieldView& field, const SliceWindow& window, int v,
    const Range<int>& columns, const Range<int>& nodes)
  {
    const float* source = field.values + field.At(nodes.begin, 0, v);
    float* target = window.Row(nodes.begin, v);
    for (int tile = columns.begin; tile < columns.end; tile += columnsPerTile)
    {
      const int last = std::min(tile + columnsPerTile, columns.end);
      for (int k = 0; k < nodes.Length(); ++k)
      {
        for (int u = tile; u < last; ++u)
        {
          target[k * window.strideW + u] = source[field.stride[1] * u + k];
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

/// Fields of which some are made for each slab.
class MadeSlabs : public TransposedSlabs
{
public:
  MadeSlabs(const FaceFrustum& frustum, const BandDecomposition& bands, MadeFields& made)
    : TransposedSlabs(frustum, bands)
    , Fields(&made)
  {
  }

  SliceWindow Open(float* field, const FieldUse& use) override
  {
    const FaceFrustum& plan = this->Frustum;
    if (plan.axisW == 0)
    {
      return CopiedSlabs::Open(field, use);
    }
    return { field, use, plan.nodesU, plan.nodesV, plan.strideV, plan.strideW, field };
  }

  void Load(const Range<int>& slab, const Occupancy* occupancy, Windows& windows) const override
  {
    this->Make(slab, windows);
    for (SliceWindow& window : windows)
    {
      const bool isMade = this->Fields->Has(window.field);
      if (this->Frustum.axisW == 0)
      {
        this->Transpose(isMade ? this->Fields->Values(window.field) : this->InPlace(window), slab,
          occupancy, window);
      }
      else if (isMade)
      {
        const FieldView view = this->Fields->Values(window.field);
        window.values = view.values;
        window.strideV = view.stride[std::size_t(this->Frustum.axisV)];
        window.strideW = view.stride[std::size_t(this->Frustum.axisW)];
      }
    }
  }

private:
  /// Makes the fields of all windows, in whole rows where these are not transposed: they are read
  /// register by register.
  void Make(const Range<int>& slab, const Windows& windows) const
  {
    std::vector<const float*> fields;
    int inFront = 0;
    int behind = 0;
    for (const SliceWindow& window : windows)
    {
      if (this->Fields->Has(window.field))
      {
        fields.push_back(window.field);
        inFront = std::max(inFront, window.use.inFront);
        behind = std::max(behind, window.use.behind);
      }
    }
    const Box read = this->BoxRead(slab, inFront, behind);
    NodeBox box;
    box.along[std::size_t(this->Frustum.axisU)] =
      this->Frustum.axisU == 0 ? Range<int>{ 0, this->Frustum.nodesU } : read.columns;
    box.along[std::size_t(this->Frustum.axisV)] = read.rows;
    box.along[std::size_t(this->Frustum.axisW)] = read.nodes;
    this->Fields->MoveTo(box, fields);
  }

  MadeFields* Fields;
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

std::unique_ptr<FieldSlabs> FieldSlabs::Made(
  const FaceFrustum& frustum, const BandDecomposition& bands, MadeFields& made)
{
  return std::make_unique<MadeSlabs>(frustum, bands, made);
}
}
