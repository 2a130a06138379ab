// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_StructureSampler_h
#define limpid_energy_StructureSampler_h

#include "scene/Structures.h"
#include "sweep/RaySampler.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace limpid
{
/// The fields of a ledger, one value per node each.
struct LedgerFields
{
  const float* extinction;  ///< [1/length]
  const float* base;        ///< base extinction; in ceilings the lower bound, or null [1/length]
  const StructureRow* rows; ///< row of the structure of each node
  bool bounded = false;     ///< whether `base` is the lower bound
};

/**
 * Samples a ray through structures, on the processor. Its importance is the membership of some of
 * them: a share of each node, interpolated between nodes. Everything else is as for other rays.
 */
class StructureSampler : public RaySampler
{
public:
  using RaySampler::RaySampler;

  /// Sets the share of importance of each row [0, 1], Structures::Count() + 1 values, which the
  /// caller keeps.
  void SetShares(const float* shares) { this->Shares = shares; }

  /// Tells whether all nodes near the layer are of one row, so that importance need not be sampled.
  void SetOneRow(bool isOne) { this->IsOne = isOne; }

  /// Samples what a step needs at the Gauss points of the layer.
  void Sample(const LedgerFields& fields)
  {
    this->Given = &fields;
    this->SampleExtinction(fields.extinction);
    for (std::size_t half = 0; half < 2; ++half)
    {
      const Corner& corner = this->Corners[half];
      this->Ray.importance[half] = this->Important(corner);
      this->Ray.kept[half] = this->Kept(corner, this->Ray.extinction[half]);
    }
  }

  /// Calls visit(row) for the rows of all nodes that samples of the layer may read, some of them
  /// several times.
  template <class Visit>
  void ForRowsNear(const StructureRow* rows, const Visit& visit) const
  {
    const auto& u = this->Frustum.Row(this->Frustum.columnLines)[this->I];
    const auto& v = this->Frustum.Row(this->Frustum.rowLines)[this->J];
    const double front = this->Ray.layer.front;
    const double back = front + this->Ray.layer.thickness;
    const auto between = [](int first, int second) -> Range<int> {
      return { std::min(first, second), std::max(first, second) + 2 };
    };
    const auto first = [](double position, int nodes) { return NodesAt(position, nodes).first; };
    const Range<int> columns =
      between(first(u.At(front), this->Frustum.nodesU), first(u.At(back), this->Frustum.nodesU));
    const Range<int> lines =
      between(first(v.At(front), this->Frustum.nodesV), first(v.At(back), this->Frustum.nodesV));
    const Slice& slice = this->Frustum.SliceAt(this->S);
    for (const int w : slice.nodes)
    {
      for (int line = lines.begin; line < lines.end; ++line)
      {
        const Index start = Index(w) * this->Frustum.strideW + Index(line) * this->Frustum.strideV;
        for (int column = columns.begin; column < columns.end; ++column)
        {
          visit(rows[start + Index(column) * this->Frustum.strideU]);
        }
      }
    }
  }

  PointSample SampleAt(const RayFields<Field>& fields, float share, int) const
  {
    const Corner corner = this->CornerOf(share);
    const float extinction = this->SampleLayer(fields.extinction, corner);
    return { extinction, this->Important(corner), this->Kept(corner, extinction) };
  }

  /// Calls step(ray, 0) with the layer, resolved if necessary.
  template <class Resolve, class Step>
  void ForEachResolved(const Resolve& resolve, const Step& step) const
  {
    const RayFields<Field> fields{ this->Given->extinction, nullptr, this->Given->base };
    StepResolved(this->Ray, *this, fields, resolve, this->I, 0, step,
      [&](Index) { this->ForEachInLayer(step); });
  }

private:
  float Important(const Corner& corner) const
  {
    const auto shareOf = [this](Node node) { return this->Shares[this->Given->rows[node]]; };
    return this->InView() *
      (this->IsOne ? shareOf(corner.front) : this->BlendLayer(shareOf, corner));
  }

  /// Kept base extinction, or the lower bound of the extinction of the structures. `sampled`: the
  /// extinction there.
  float Kept(const Corner& corner, float sampled) const
  {
    const LedgerFields& fields = *this->Given;
    if (!fields.bounded)
    {
      return fields.base ? this->BlendLayer(LesserOf{ fields.extinction, fields.base }, corner)
                         : sampled;
    }
    return fields.base ? this->BlendLayer([this, &fields](Node node)
                           { return this->Shares[fields.rows[node]] * fields.base[node]; },
                           corner)
                       : 0.0f;
  }

  const LedgerFields* Given = nullptr;
  const float* Shares = nullptr;
  bool IsOne = false; ///< see SetOneRow
};
}

#endif
