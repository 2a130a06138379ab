// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "energy/VisibilityTerm.h"

#include "energy/GradientVoxel.h"
#include "sweep/RayMeans.h"
#include "sweep/Registers.h"

#include <algorithm>

namespace limpid
{
namespace
{
LIMPID_MULTIVERSION
void GradientRow(const GradientVoxel<float>& body, const GradientTarget& target,
  const float* __restrict transmittance, const float* __restrict behind,
  const float* __restrict importance, const Range<int>& columns, float* __restrict gradient)
{
  const GradientVoxel<float> voxel = body;
  const GradientTarget sum = target;
  for (int u = columns.begin; u < columns.end; ++u)
  {
    gradient[u] = sum.Of(gradient[u], voxel(transmittance[u], behind[u], importance[u]));
  }
}

/// What all backward sweeps through a fixed extinction share: the rays.
class RayCarrier
{
public:
  RayCarrier(
    const FaceFrustum& frustum, const RayFields& fields, Derivative derivative, RayImages& images)
    : Source(frustum)
    , Images(images)
    , Widens(derivative == Derivative::Volume)
    , Extinction(frustum, *fields.grid, fields.extinction, images.slabs, fields.occupancy)
    , Importance(frustum, *fields.grid, fields.importance, images.slabs, fields.occupancy)
  {
    StartBehind(images);
  }

  void Load(const Range<int>& slab)
  {
    this->Extinction.Load(slab, 1);
    this->Importance.Load(slab, 1);
  }

  /// Moves a row of rays to slice `s`.
  void RayRow(int s, int row)
  {
    const Range<int>& work = this->Source.slices[std::size_t(s)].work[std::size_t(row)];
    if (work.Empty())
    {
      return;
    }
    float* memory = ThreadScratch(LayerMemory(this->Source));
    const bool last = s == this->Source.LastSlice();
    if (!last)
    {
      this->Carry(s, row, memory);
    }
    TransmitRays(
      this->Source, s, row, work, last ? nullptr : memory, Depths::Unwound, this->Images);
  }

  /// Moves a row of rays from the first slice of voxels to the eye.
  void Leave(int row)
  {
    for (int s = this->Source.FirstNodeSlice(); s-- > 0;)
    {
      this->Carry(s, row, ThreadScratch(LayerMemory(this->Source)));
    }
  }

  float AreaOf(const Slice& slice) const { return this->Widens ? slice.scale * slice.scale : 1.0f; }

  const FaceFrustum& Source;
  RayImages& Images;
  bool Widens; ///< whether rays carry the weight of Deviation D1
  SliceWindow Extinction;
  SliceWindow Importance;

private:
  /// From the back of the layer behind slice `s` to its front.
  void Carry(int s, int row, float* memory)
  {
    limpid::RayRow rays = RaysOf(this->Source, this->Images, s, row);
    if (!this->Widens)
    {
      rays.layer.frontScale = rays.layer.backScale = 1;
    }
    SampleLayer(this->Source, s, row, this->Extinction, this->Importance, memory, rays);
    BackwardRow(rays, this->Images.Behind(this->Source, row));
  }
};

class GradientVisitor : public RayCarrier
{
public:
  GradientVisitor(const RayCarrier& rays, const RayFields& fields, const float* nodeImportance,
    const GradientTarget& target)
    : RayCarrier(rays)
    , Target(target)
    , Occupied(*fields.occupancy)
    , NodeImportance(rays.Source, *fields.grid, nodeImportance, rays.Images.slabs, fields.occupancy)
    , Gradient(rays.Source, *fields.grid, target.field, rays.Images.slabs, fields.occupancy)
  {
  }

  void Load(const Range<int>& slab)
  {
    this->RayCarrier::Load(slab);
    this->NodeImportance.Load(slab, 0);
    this->Gradient.Load(slab, 0);
  }

  void VoxelRow(int s, int v)
  {
    const Slice& slice = this->Source.slices[std::size_t(s)];
    const Range<int> owned = slice.ownedColumns;
    const Range<int> filled = SpansOf(this->Source, this->Occupied, slice.node, v).filled;
    const Range<int> columns = WholeRegisters(
      Intersection(this->Source.VoxelColumns(slice, v), Intersection(filled, owned)), owned);
    if (columns.Empty())
    {
      return;
    }
    this->NodeImportance.Prefetch(slice.node, v + 1, columns);
    this->Gradient.Prefetch(slice.node, v + 1, columns);
    const auto nodes = std::size_t(this->Source.nodesU);
    float* memory = ThreadScratch(3 * nodes + MeanScratch(this->Source));
    float* transmittance = memory;
    float* behind = memory + nodes;
    float* importance = memory + 2 * nodes;
    float* scratch = memory + 3 * nodes;
    AverageSeen(this->Source, slice, v, columns, this->Images, this->Images.behind, scratch,
      { transmittance, behind });
    const float* source = this->NodeImportance.Row(slice.node, v);
    if (!this->Source.inView.empty())
    {
      SampleRays(this->Source, slice, v, columns, this->Source.inView, scratch, importance);
      MultiplyRow(importance, source, columns);
      source = importance;
    }
    GradientRow({ 1.0f / this->AreaOf(slice) }, this->Target, transmittance, behind, source,
      columns, this->Gradient.Row(slice.node, v));
  }

  void Store(const Range<int>& slab) { this->Gradient.Store(slab); }

private:
  GradientTarget Target;
  const Occupancy& Occupied; ///< where there is nothing, derivatives are of no use
  SliceWindow NodeImportance;
  SliceWindow Gradient;
};
}

VisibilityTerm::VisibilityTerm(
  const Grid& grid, const Occupancy& occupancy, const RaySource& eye, double rayDensity)
  : Nodes(grid)
  , Occupied(&occupancy)
  , Frusta(PlanSweep(grid, occupancy, eye, rayDensity))
{
  this->Images.reserve(this->Frusta.size());
  for (const FaceFrustum& frustum : this->Frusta)
  {
    this->Images.emplace_back(frustum);
  }
}

Visible VisibilityTerm::Forward(const float* extinction, const float* importance)
{
  Visible sum;
  for (std::size_t index = 0; index < this->Frusta.size(); ++index)
  {
    sum += this->ForwardAt(index, extinction, importance);
  }
  return sum;
}

Visible VisibilityTerm::ForwardAt(
  std::size_t index, const float* extinction, const float* importance)
{
  return SweepForward(this->Frusta[index], { &this->Nodes, this->Occupied, extinction, importance },
    this->Images[index]);
}

Visible VisibilityTerm::AddGradient(
  const TermFields& fields, Derivative derivative, float weight, float* gradient)
{
  return this->Differentiate(fields, derivative, { 1.0f, weight, gradient });
}

Visible VisibilityTerm::SetGradient(
  const TermFields& fields, Derivative derivative, float* gradient)
{
  return this->Differentiate(fields, derivative, { 0.0f, 1.0f, gradient });
}

Visible VisibilityTerm::Differentiate(
  const TermFields& fields, Derivative derivative, const GradientTarget& target)
{
  // Without the weight of the rays, what they carry is not the score.
  const bool carriesScore = derivative == Derivative::Volume;
  const RayFields swept{ &this->Nodes, this->Occupied, fields.extinction, fields.importance };
  Visible sum;
  if (!carriesScore)
  {
    sum = this->Forward(fields.extinction, fields.importance);
  }
  for (std::size_t index = 0; index < this->Frusta.size(); ++index)
  {
    const FaceFrustum& frustum = this->Frusta[index];
    RayImages& images = this->Images[index];
    if (carriesScore)
    {
      SweepDepths(frustum, swept, images);
    }
    const RayCarrier rays(frustum, swept, derivative, images);
    GradientVisitor visitor(rays, swept, fields.nodeImportance, target);
    SweepBackward(frustum, visitor);
    sum += carriesScore ? SumBehind(frustum, images) : Visible{};
  }
  return sum;
}
}
