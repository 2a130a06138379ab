// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A row of rays through structures, on the processor. Most layers of a ray are within one
// structure: they are visited several columns per vector register, as in a score. The others are
// visited one by one.

#ifndef limpid_energy_StructureRowSampler_h
#define limpid_energy_StructureRowSampler_h

#include "energy/LedgerRays.h"
#include "energy/LedgerSums.h"
#include "energy/StructureCells.h"
#include "energy/StructuresHere.h"
#include "sweep/RowSampler.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace limpid
{
/// The fields of a ledger.
template <class Field>
struct LedgerFields
{
  Field extinction; ///< [1/length]
  Field bound;      ///< front to back: base extinction, null for `extinction`; back to front: lower
                    ///< bound of the extinction, null for 0 [1/length]
  Field rows;       ///< number of the row of the structure of each node
};

/// What all rows of rays share.
struct LedgerSweep
{
  LedgerFields<SliceWindow*> fields;
  const std::vector<float>& importance; ///< [row] of the structures
  float majorant;                       ///< of the base extinction [1/length]
  LedgerRays& rays;
};

/// A row of rays of a frustum, which knows the structures that its rays meet.
class StructureRowSampler : public RowSampler
{
public:
  StructureRowSampler(const FaceFrustum& frustum, const RayStates& states, int row,
    const LedgerSweep& sweep, SumsByStructure& sums)
    : RowSampler(frustum, states, row,
        rowArrays * std::size_t(frustum.columns) + 2 * std::size_t(frustum.nodesU))
    , Sweep(sweep)
    , Sums(sums)
    , Remembered(sweep.rays.all.data() + frustum.RayAt(0, row))
    , Was(sweep.rays.in.data() + frustum.RayAt(0, row))
    , Weights(sweep.rays.weights.data() + frustum.RayAt(0, row))
    , Free(this->More)
  {
    for (float** values : { &this->In, &this->Important, &this->IsResolved })
    {
      *values = this->Take(frustum.columns);
    }
    this->Differs = this->Take(frustum.nodesU);
    this->InCell = this->Take(frustum.nodesU);
  }

protected:
  static constexpr std::size_t rowArrays = 9; ///< by column, with those of derived classes

  /// Importance of a row if one structure alone is important.
  struct Membership
  {
    StructureRow wanted;

    float operator()(StructureRow row) const { return row == this->wanted ? 1.0f : 0.0f; }
  };

  /// A ray with the membership of one structure, or with the importance of all.
  template <class ShareOf>
  struct RayOf
  {
    using Field = SliceWindow*;

    RayOf(const StructureRowSampler& among, const ShareOf& importanceOf, bool isBounded)
      : rays(among)
      , shareOf(importanceOf)
      , bounded(isBounded)
    {
    }

    const StructureRowSampler& rays;
    const ShareOf& shareOf; ///< importance of a row
    bool bounded;           ///< whether `bound` is the lower bound of the structure's extinction

    Range<float> FacesCrossed(int column) const { return this->rays.FacesCrossed(column); }

    PointSample SampleAt(const RayFields<Field>& fields, float share, int column) const
    {
      const auto extinction = ValuesOf(fields.extinction);
      const auto rowAt = ValuesOf(this->rays.Sweep.fields.rows);
      const auto membership = [&](int node, int row, int at)
      { return this->shareOf(RowOf(rowAt(node, row, at))); };
      const auto kept = [&](int node, int row, int at)
      {
        const float there = ValuesOf(fields.base)(node, row, at);
        return this->bounded ? membership(node, row, at) * there
                             : std::min(extinction(node, row, at), there);
      };
      const LayerPlace place = this->rays.PlaceAt(share, column);
      PointSample found;
      found.extinction = place.Blend(extinction);
      found.importance = place.Blend(membership);
      found.kept = fields.base ? place.Blend(kept) : this->bounded ? 0.0f : found.extinction;
      return found;
    }
  };

  /// Selects the rays to visit in a layer, and finds the structures that they are in.
  template <class Leave>
  bool Enter(int s, const Leave& leave)
  {
    if (!this->EnterLayer(s, true))
    {
      return false;
    }
    this->FindRows();
    this->Several.clear();
    for (int column = this->Rays.columns.begin; column < this->Rays.columns.end; ++column)
    {
      const float in = this->In[column];
      if (in != this->Was[column])
      {
        leave(column, in);
      }
      if (in == LedgerRays::several && this->Weights[column] > 0)
      {
        this->Several.push_back(column);
        this->IsResolved[column] = 0;
      }
    }
    this->SampleExtinction(this->Sweep.fields.extinction);
    this->Rays.importance[0] = this->Rays.importance[1] = this->Important;
    return true;
  }

  RowsOfStructures RowsAt(int half, const SliceWindow* bound) const
  {
    const Slice& slice = this->Frustum.SliceAt(this->S);
    const LinearMap columns = this->Frustum.PlaneColumns(2 * this->S + half);
    const LinearMap rows = this->Frustum.PlaneRows(2 * this->S + half);
    const float along[2] = { 1 - slice.fractions[half], slice.fractions[half] };
    const float across[2] = { 1 - rows.weight[this->RowNumber], rows.weight[this->RowNumber] };
    RowsOfStructures four{ columns.index, columns.weight, {}, {}, {} };
    for (int row = 0; row < 4; ++row)
    {
      const auto rowOf = [&](const SliceWindow* field)
      { return field->Row(slice.nodes[row / 2], rows.index[this->RowNumber] + row % 2); };
      four.weight[row] = along[row / 2] * across[row % 2];
      four.number[row] = rowOf(this->Sweep.fields.rows);
      four.bound[row] = bound ? rowOf(bound) : nullptr;
    }
    return four;
  }

  /// Finds the structures at the Gauss points of a ray.
  static StructuresHere StructuresAt(int column, const RowsOfStructures (&four)[2])
  {
    StructuresHere here;
    four[0].AddShares(column, 0, here);
    four[1].AddShares(column, 1, here);
    return here;
  }

  /// Adds the structures of all nodes that samples of a resolved layer may read.
  void AddAllNear(int column, StructuresHere& here) const
  {
    const Range<int> columns =
      this->CellsOf(this->Frustum.Row(this->Frustum.columnLines)[column], this->Frustum.nodesU);
    const Range<int> rows = this->RowsOfCells();
    for (const int node : this->Frustum.SliceAt(this->S).nodes)
    {
      for (int row = rows.begin; row <= rows.end; ++row)
      {
        const float* numbers = this->Sweep.fields.rows->Row(node, row);
        for (int at = columns.begin; at <= columns.end; ++at)
        {
          here.IndexOf(numbers[at]);
        }
      }
    }
  }

  /// A ray with an importance of its own. `importance`: at the Gauss points.
  RayInLayer<LayerCrossing::Clipped> RayAt(
    int column, const StructuresHere::AtGaussPoints& importance) const
  {
    RayInLayer<LayerCrossing::Clipped> ray = this->Rays.At<LayerCrossing::Clipped>(column);
    ray.importance[0] = importance[0];
    ray.importance[1] = importance[1];
    return ray;
  }

  /// Calls step for such a ray, with a ResolvedRay if the layer is resolved.
  template <class Sampler, class Resolving, class Step>
  void Resolve(int column, const RayInLayer<LayerCrossing::Clipped>& ray, const Sampler& sampler,
    const Resolving& resolve, const Step& step) const
  {
    StepResolved(ray, sampler,
      RayFields<SliceWindow*>{ this->Sweep.fields.extinction, nullptr, this->Sweep.fields.bound },
      resolve, column, 0, step, [&](Index) { StepPlainly(ray, step); });
  }

  /// Calls step for a ray whose layer is not resolved.
  template <class Step>
  static void StepPlainly(const RayInLayer<LayerCrossing::Clipped>& ray, const Step& step)
  {
    if (ray.StaysInside())
    {
      step(RayInLayer<LayerCrossing::Through>{ ray.layer, ray.length, ray.column, ray.row,
             { ray.extinction[0], ray.extinction[1] }, { ray.importance[0], ray.importance[1] },
             { ray.kept[0], ray.kept[1] } },
        0);
    }
    else
    {
      step(ray, 0);
    }
  }

  /// Calls act(column) for the rays that count, in parts of the row that have rays.
  template <class Act>
  void ForRays(const Act& act)
  {
    const Range<int>& columns = this->Frustum.ColumnsOf(this->RowNumber);
    for (int column = columns.begin; column < columns.end; ++column)
    {
      if (this->Weights[column] > 0)
      {
        act(column);
      }
    }
  }

  /// Returns scratch memory.
  float* Take(int count)
  {
    float* taken = this->Free;
    this->Free += count;
    return taken;
  }

  const LedgerSweep& Sweep;
  SumsByStructure& Sums;
  LedgerRay* Remembered;    ///< of this row, by column
  float* Was;               ///< see LedgerRays::in
  const double* Weights;    ///< see LedgerRays
  std::vector<int> Several; ///< columns of rays in several structures
  // By column:
  float* In;         ///< see LedgerRays
  float* Important;  ///< importance in samples: the number of the row in one structure
  float* IsResolved; ///< whether the layer of a ray in several structures is resolved

private:
  /// Depths of both ends of the layer.
  Range<double> Ends() const
  {
    const double front = this->Rays.layer.front;
    return { front, front + this->Rays.layer.thickness };
  }

  /// Cells that a line crosses in the layer; their nodes are one more.
  Range<int> CellsOf(const RayLine& line, int nodes) const
  {
    const Range<double> ends = this->Ends();
    const int first = NodesAt(line.At(ends.begin), nodes).first;
    const int last = NodesAt(line.At(ends.end), nodes).first;
    return { std::min(first, last), std::max(first, last) + 1 };
  }

  Range<int> RowsOfCells() const
  {
    return this->CellsOf(
      this->Frustum.Row(this->Frustum.rowLines)[this->RowNumber], this->Frustum.nodesV);
  }

  /// Finds the structure that each ray is in, from all nodes that samples of the layer may read.
  void FindRows()
  {
    const RayLine* lines = this->Frustum.Row(this->Frustum.columnLines);
    const int nodesU = this->Frustum.nodesU;
    const Range<int> columns = this->Rays.columns;
    const Range<int> read = Hull(
      this->CellsOf(lines[columns.begin], nodesU), this->CellsOf(lines[columns.end - 1], nodesU));
    this->FindCells(this->RowsOfCells(), read);
    FindStructures(lines, columns, this->Ends(), this->InCell, nodesU, this->In);
    for (int i = columns.begin; i < columns.end; ++i)
    {
      this->Important[i] = this->In[i] < 0.0f ? 1.0f : this->In[i];
    }
  }

  /// Finds the structure of the nodes of each cell, LedgerRays::several if they differ.
  void FindCells(const Range<int>& rows, const Range<int>& read)
  {
    const int* slices = this->Frustum.SliceAt(this->S).nodes;
    const SliceWindow& window = *this->Sweep.fields.rows;
    const float* first = window.Row(slices[0], rows.begin);
    std::fill(this->Differs + read.begin, this->Differs + read.end + 1, 0.0f);
    for (int slice = 0; slice < 2; ++slice)
    {
      for (int v = rows.begin; v <= rows.end; ++v)
      {
        MarkDifferences(
          window.Row(slices[slice], v), first, { read.begin, read.end + 1 }, this->Differs);
      }
    }
    FindStructuresOfCells(first, this->Differs, read, this->InCell);
  }

  float* Free;
  // By column of nodes:
  float* Differs; ///< whether the nodes of the layer differ along v or w
  float* InCell;  ///< see FindCells
};
}

#endif
