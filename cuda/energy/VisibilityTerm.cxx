// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "energy/VisibilityTerm.h"

#include "energy/GradientVoxel.h"
#include "sweep/RayMeans.h"

#include <algorithm>

namespace limpid
{
namespace
{
LIMPID_MULTIVERSION
void GradientRow(const GradientVoxel<float>& body, const GradientTarget& target,
  const float* __restrict transmittance, const float* __restrict behind,
  const float* __restrict importance, const Interval& columns, float* __restrict gradient)
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
    const Pyramid& pyramid, const RayFields& fields, Derivative derivative, RayImages& images)
    : Source(pyramid)
    , Images(images)
    , Widens(derivative == Derivative::Volume)
    , Extinction(pyramid, *fields.grid, fields.extinction, images.slabs, fields.occupancy)
    , Importance(pyramid, *fields.grid, fields.importance, images.slabs, fields.occupancy)
  {
    StartBehind(images);
  }

  void Load(const Slab& slab)
  {
    this->Extinction.Load(slab, 1);
    this->Importance.Load(slab, 1);
  }

  /// Moves a row of rays to station `s`.
  void RayRow(int s, int row)
  {
    const Interval& work = this->Source.stations[std::size_t(s)].work[std::size_t(row)];
    if (work.Empty())
    {
      return;
    }
    float* memory = ThreadScratch(LayerMemory(this->Source));
    const bool last = s == this->Source.LastStation();
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
    for (int s = this->Source.FirstSlice(); s-- > 0;)
    {
      this->Carry(s, row, ThreadScratch(LayerMemory(this->Source)));
    }
  }

  float AreaOf(const Station& station) const
  {
    return this->Widens ? station.scale * station.scale : 1.0f;
  }

  const Pyramid& Source;
  RayImages& Images;
  bool Widens; ///< whether rays carry the weight of Deviation D1
  SliceWindow Extinction;
  SliceWindow Importance;

private:
  /// From the back of the layer behind station `s` to its front.
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

  void Load(const Slab& slab)
  {
    this->RayCarrier::Load(slab);
    this->NodeImportance.Load(slab, 0);
    this->Gradient.Load(slab, 0);
  }

  void VoxelRow(int s, int v)
  {
    const Station& station = this->Source.stations[std::size_t(s)];
    const Interval owned = station.ownedColumns;
    const Interval filled = SpansOf(this->Source, this->Occupied, station.slice, v).filled;
    const Interval columns = FilledRegisters(
      Intersection(this->Source.VoxelColumns(station, v), Intersection(filled, owned)), owned);
    if (columns.Empty())
    {
      return;
    }
    this->NodeImportance.Prefetch(station.slice, v + 1, columns);
    this->Gradient.Prefetch(station.slice, v + 1, columns);
    const auto nodes = std::size_t(this->Source.nodesU);
    float* memory = ThreadScratch(3 * nodes + MeanScratch(this->Source));
    float* transmittance = memory;
    float* behind = memory + nodes;
    float* importance = memory + 2 * nodes;
    float* scratch = memory + 3 * nodes;
    AverageSeen(this->Source, station, v, columns, this->Images, this->Images.behind, scratch,
      { transmittance, behind });
    const float* source = this->NodeImportance.Row(station.slice, v);
    if (!this->Source.inView.empty())
    {
      SampleRays(this->Source, station, v, columns, this->Source.inView, scratch, importance);
      MultiplyRow(importance, source, columns);
      source = importance;
    }
    GradientRow({ 1.0f / this->AreaOf(station) }, this->Target, transmittance, behind, source,
      columns, this->Gradient.Row(station.slice, v));
  }

  void Store(const Slab& slab) { this->Gradient.Store(slab); }

private:
  GradientTarget Target;
  const Occupancy& Occupied; ///< where there is nothing, derivatives are of no use
  SliceWindow NodeImportance;
  SliceWindow Gradient;
};
}

VisibilityTerm::VisibilityTerm(
  const Grid& grid, const Occupancy& occupancy, const Eye& eye, double rayDensity)
  : Nodes(grid)
  , Occupied(&occupancy)
  , Pyramids(PlanSweep(grid, occupancy, eye, rayDensity))
{
  this->Images.reserve(this->Pyramids.size());
  for (const Pyramid& pyramid : this->Pyramids)
  {
    this->Images.emplace_back(pyramid);
  }
}

Visible VisibilityTerm::Forward(const float* extinction, const float* importance)
{
  Visible sum;
  for (std::size_t index = 0; index < this->Pyramids.size(); ++index)
  {
    sum += this->ForwardAt(index, extinction, importance);
  }
  return sum;
}

Visible VisibilityTerm::ForwardAt(
  std::size_t index, const float* extinction, const float* importance)
{
  return SweepForward(this->Pyramids[index],
    { &this->Nodes, this->Occupied, extinction, importance }, this->Images[index]);
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
  for (std::size_t index = 0; index < this->Pyramids.size(); ++index)
  {
    const Pyramid& pyramid = this->Pyramids[index];
    RayImages& images = this->Images[index];
    if (carriesScore)
    {
      SweepDepths(pyramid, swept, images);
    }
    const RayCarrier rays(pyramid, swept, derivative, images);
    GradientVisitor visitor(rays, swept, fields.nodeImportance, target);
    SweepBackward(pyramid, visitor);
    sum += carriesScore ? SumBehind(pyramid, images) : Visible{};
  }
  return sum;
}
}
