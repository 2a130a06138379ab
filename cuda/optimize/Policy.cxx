// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Policy.h"

#include "energy/GradientVoxel.h"
#include "optimize/PolicyVoxel.h"
#include "optimize/Terms.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
/// The voxels of one row. All arrays are indexed by column.
struct PolicyRowArrays
{
  const float* transmittance; ///< [0, 1]
  const float* behind;        ///< [scale^2]
  const float* importance;    ///< [0, 1]
  const float* base;          ///< [1/length]
  const float* lagged;        ///< T (V - g) of the other term; null: none
  float* extinction;          ///< out [1/length]
};

LIMPID_MULTIVERSION
void PolicyRow(const PolicyVoxel<float>& policy, const GradientVoxel<float>& gradient,
  const PolicyRowArrays& arrays, const Interval& columns)
{
  const PolicyVoxel<float> voxel = policy;
  const GradientVoxel<float> derivative = gradient;
  const float* __restrict transmittance = arrays.transmittance;
  const float* __restrict behind = arrays.behind;
  const float* __restrict importance = arrays.importance;
  const float* __restrict base = arrays.base;
  const float* __restrict lagged = arrays.lagged;
  float* __restrict extinction = arrays.extinction;
  if (lagged)
  {
    for (int u = columns.begin; u < columns.end; ++u)
    {
      extinction[u] =
        voxel(base[u], derivative(transmittance[u], behind[u], importance[u]), lagged[u]);
    }
  }
  else
  {
    for (int u = columns.begin; u < columns.end; ++u)
    {
      extinction[u] = voxel(base[u], derivative(transmittance[u], behind[u], importance[u]), 0.0f);
    }
  }
}

/// Voxels that no important structure of the swept term needs: only the other term counts.
LIMPID_MULTIVERSION
void LaggedRow(
  const PolicyVoxel<float>& policy, const PolicyRowArrays& arrays, const Interval& columns)
{
  const PolicyVoxel<float> voxel = policy;
  const float* __restrict base = arrays.base;
  const float* __restrict lagged = arrays.lagged;
  float* __restrict extinction = arrays.extinction;
  for (int u = columns.begin; u < columns.end; ++u)
  {
    extinction[u] = voxel(base[u], 0.0f, lagged ? lagged[u] : 0.0f);
  }
}

/// Fields of a policy sweep, grid.NodeCount() values each.
struct PolicyFields
{
  const float* base;           ///< [1/length]
  const float* importance;     ///< [0, 1]
  const float* nodeImportance; ///< see NodeImportance.h [0, 1]
  const float* extinction;     ///< the last iterate [1/length]
  const float* lagged;         ///< T (V - g) of the other term; null: none
  float* next;                 ///< the next iterate [1/length]
};

/// The backward sweep of one pyramid.
class PolicyVisitor
{
public:
  PolicyVisitor(const Pyramid& pyramid, const Grid& grid, const PolicyVoxel<float>& voxel,
    const PolicyFields& fields, bool trustTransmittance, bool widens, RayImages& images)
    : Source(pyramid)
    , Images(images)
    , Voxel(voxel)
    , TrustTransmittance(trustTransmittance)
    , Widens(widens)
    , HasLagged(fields.lagged != nullptr)
    , Base(pyramid, grid, fields.base)
    , Importance(pyramid, grid, fields.importance)
    , NodeImportance(pyramid, grid, fields.nodeImportance)
    , Extinction(pyramid, grid, fields.extinction)
    , Lagged(pyramid, grid, fields.lagged)
    , Next(pyramid, grid, fields.next)
    , Ahead(images.behind.size(), 0.0f)
  {
    std::fill(images.behind.begin(), images.behind.end(), 0.0f);
    std::fill(images.transmittance.begin(), images.transmittance.end(), 1.0f);
  }

  void Load(const Slab& slab)
  {
    this->Base.Load(slab, 0);
    this->NodeImportance.Load(slab, 0);
    this->Importance.Load(slab, 2);
    this->Next.Load(slab, 2);
    if (this->TrustTransmittance)
    {
      this->Extinction.Load(slab, 1);
    }
    if (this->HasLagged)
    {
      this->Lagged.Load(slab, 0);
    }
  }

  void Store(const Slab& slab) { this->Next.Store(slab); }

  /// Moves a row of rays to station `s`, whose voxels are to be found next. The voxels behind are
  /// final.
  void RayRow(int s, int row)
  {
    float* memory =
      ThreadScratch(4 * std::size_t(this->Source.columns) + ScratchSize(this->Source));
    const int last = this->Source.LastStation();
    if (s + 1 < last)
    {
      this->CarryThroughLayer(s + 1, row, memory);
    }
    if (s < last)
    {
      this->LookAhead(s, row, memory);
    }
    if (this->TrustTransmittance)
    {
      this->UnwindTransmittance(s, row, memory);
    }
  }

  void VoxelRow(int s, int v)
  {
    const Station& station = this->Source.stations[std::size_t(s)];
    const Interval owned = station.ownedColumns;
    const Interval columns = Intersection(this->Source.VoxelColumns(station, v), owned);
    PolicyRowArrays arrays{};
    arrays.base = this->Base.Row(station.slice, v);
    arrays.lagged = this->HasLagged ? this->Lagged.Row(station.slice, v) : nullptr;
    arrays.extinction = this->Next.Row(station.slice, v);
    if (columns.Empty())
    {
      LaggedRow(this->Voxel, arrays, owned);
      return;
    }
    LaggedRow(this->Voxel, arrays, { owned.begin, columns.begin });
    LaggedRow(this->Voxel, arrays, { columns.end, owned.end });

    const auto nodes = std::size_t(this->Source.nodesU);
    float* memory = ThreadScratch(3 * nodes + ScratchSize(this->Source));
    float* scratch = memory + 3 * nodes;
    if (this->TrustTransmittance)
    {
      SampleTransmittance(this->Source, station, v, columns, this->Images, scratch, memory);
    }
    else
    {
      std::fill(memory + columns.begin, memory + columns.end, 1.0f);
    }
    SampleRays(this->Source, station, v, columns, this->Ahead, scratch, memory + nodes);
    arrays.transmittance = memory;
    arrays.behind = memory + nodes;
    arrays.importance = this->NodeImportance.Row(station.slice, v);
    if (!this->Source.inView.empty())
    {
      float* seen = memory + 2 * nodes;
      SampleRays(this->Source, station, v, columns, this->Source.inView, scratch, seen);
      MultiplyRow(seen, arrays.importance, columns);
      arrays.importance = seen;
    }
    const float area = this->Widens ? station.scale * station.scale : 1.0f;
    PolicyRow(this->Voxel, { 1.0f / area }, arrays, columns);
  }

private:
  limpid::RayRow Rays(int s, int row) const
  {
    limpid::RayRow rays = RaysOf(this->Source, this->Images, s, row);
    if (!this->Widens)
    {
      rays.layer.frontScale = rays.layer.backScale = 1;
    }
    return rays;
  }

  const Plane& PlaneAt(int s, int half) const
  {
    return this->Source.stations[std::size_t(s)].planes[std::size_t(half)];
  }

  /// Visible importance of a row of rays from the back of layer `s` to its front.
  void CarryThroughLayer(int s, int row, float* memory)
  {
    const std::size_t columns = std::size_t(this->Source.columns);
    float* scratch = memory + 4 * columns;
    limpid::RayRow rays = this->Rays(s, row);
    for (int half = 0; half < 2; ++half)
    {
      float* extinction = memory + std::size_t(half) * columns;
      float* importance = memory + std::size_t(half + 2) * columns;
      SamplePlane(
        this->PlaneAt(s, half), row, rays.work, Slices::Both, this->Next, scratch, extinction);
      SamplePlane(this->PlaneAt(s, half), row, rays.work, Slices::Both, this->Importance, scratch,
        importance);
      HideOutOfView(this->Source, row, rays.work, importance);
      rays.extinction[half] = extinction;
      rays.importance[half] = importance;
    }
    BackwardRow(rays, this->Images.behind.data() + std::size_t(row) * columns);
  }

  /// Visible importance in the middle of layer `s`. The rear half of the layer is taken to be as
  /// opaque as the slice behind it, as the slice in front is not known yet.
  void LookAhead(int s, int row, float* memory)
  {
    const std::size_t columns = std::size_t(this->Source.columns);
    float* scratch = memory + 4 * columns;
    limpid::RayRow rays = this->Rays(s, row);
    float* extinction = memory;
    float* importance = memory + columns;
    const Plane& plane = this->PlaneAt(s, 1);
    SamplePlane(plane, row, rays.work, Slices::Rear, this->Next, scratch, extinction);
    SamplePlane(plane, row, rays.work, Slices::Both, this->Importance, scratch, importance);
    HideOutOfView(this->Source, row, rays.work, importance);
    rays.extinction[0] = rays.extinction[1] = extinction;
    rays.importance[0] = rays.importance[1] = importance;
    RearHalfRow(rays, this->Images.behind.data() + std::size_t(row) * columns,
      this->Ahead.data() + std::size_t(row) * columns);
  }

  /// Transmittance on station `s` through the last iterate.
  void UnwindTransmittance(int s, int row, float* memory)
  {
    const std::size_t columns = std::size_t(this->Source.columns);
    double* opticalDepth = this->Images.opticalDepth.data() + std::size_t(row) * columns;
    const bool last = s == this->Source.LastStation();
    if (!last)
    {
      limpid::RayRow rays = this->Rays(s, row);
      for (int half = 0; half < 2; ++half)
      {
        float* extinction = memory + std::size_t(half) * columns;
        SamplePlane(this->PlaneAt(s, half), row, rays.work, Slices::Both, this->Extinction,
          memory + 4 * columns, extinction);
        rays.extinction[half] = rays.importance[half] = extinction; // importance is not used
      }
      UnwindRow(rays, opticalDepth);
    }
    TransmitRays(this->Source, s, row, last ? nullptr : memory, this->Images);
  }

  const Pyramid& Source;
  RayImages& Images;
  PolicyVoxel<float> Voxel;
  bool TrustTransmittance;
  bool Widens;
  bool HasLagged;
  SliceWindow Base;
  SliceWindow Importance;
  SliceWindow NodeImportance;
  SliceWindow Extinction;
  SliceWindow Lagged;
  SliceWindow Next;
  std::vector<float> Ahead; ///< visible importance half way to the station behind
};

class Policy : public Minimizer
{
public:
  Policy(const Problem& problem, const Occupancy& occupancy, std::vector<float> start, bool warm)
    : Task(problem)
    , Seen(problem, occupancy)
    , FilledVoxels(occupancy.FilledVoxels())
    , Warm(warm)
    , Current(std::move(start))
    , Next(Current)
    , BestIterate(Current)
  {
    if (this->Seen.camera && this->Seen.light)
    {
      this->Lagged.assign(this->Current.size(), 0.0f);
    }
  }

  IterationRecord Start() override
  {
    const IterationRecord record = this->Seen.Measure(this->Task, this->Current);
    this->BestEnergy = record.energy.Total();
    return record;
  }

  IterationRecord Iterate() override
  {
    const bool trust = this->Warm || this->Count > 0;
    this->Sweep(trust);
    ++this->Count;
    this->Current.swap(this->Next);
    this->Change = this->MeanChange();
    IterationRecord record = this->Seen.Measure(this->Task, this->Current);
    record.meanChange = this->Change;
    if (record.energy.Total() < this->BestEnergy)
    {
      this->BestEnergy = record.energy.Total();
      this->BestIterate = this->Current;
    }
    return record;
  }

  bool Converged() const override
  {
    return this->Count > 0 && this->Change < this->Task.settings.tolerance;
  }

  int IterationLimit() const override { return this->Task.settings.maximumIterations; }

  const std::vector<float>& Best() const override { return this->BestIterate; }

private:
  void Sweep(bool trust)
  {
    const Weights& weights = this->Task.settings.weights;
    VisibilityTerm& swept = this->Seen.camera ? *this->Seen.camera : *this->Seen.light;
    const bool useLagged = trust && !this->Lagged.empty();
    if (useLagged)
    {
      std::fill(this->Lagged.begin(), this->Lagged.end(), 0.0f);
      this->Seen.light->AddGradient(
        { this->Current.data(), this->Task.importance, this->Task.nodeImportance },
        this->Task.settings.derivative, 1.0f, this->Lagged.data());
    }
    // Without regularisation the optimum is bang-bang, which a large but finite gain gives, too.
    const double p = std::max(this->Task.RegularizationWeight(), 1e-30);
    const auto gainOf = [p](double weight)
    { return static_cast<float>(std::min(weight / p, 1e30)); };
    PolicyVoxel<float> voxel{};
    voxel.gain = gainOf(this->Seen.camera ? weights.view : weights.light);
    voxel.lagGain = useLagged ? gainOf(weights.light) : 0.0f;
    voxel.majorant = this->Task.majorant;
    PolicyFields fields{};
    fields.base = this->Task.baseExtinction;
    fields.importance = this->Task.importance;
    fields.nodeImportance = this->Task.nodeImportance;
    fields.extinction = this->Current.data();
    fields.lagged = useLagged ? this->Lagged.data() : nullptr;
    fields.next = this->Next.data();
    for (std::size_t index = 0; index < swept.PyramidCount(); ++index)
    {
      const Pyramid& pyramid = swept.PyramidAt(index);
      PolicyVisitor visitor(pyramid, this->Task.grid, voxel, fields, trust,
        this->Task.settings.derivative == Derivative::Volume, swept.ImagesAt(index));
      SweepBackward(pyramid, visitor);
    }
  }

  double MeanChange() const
  {
    if (this->FilledVoxels == 0 || !(this->Task.majorant > 0))
    {
      return 0;
    }
    const float* now = this->Current.data();
    const float* before = this->Next.data();
    const double sum = ParallelSum(this->Task.grid.NodeCount(),
      [=](Index voxel) { return std::abs(double(now[voxel]) - before[voxel]); });
    return sum / double(this->FilledVoxels) / this->Task.majorant;
  }

  const Problem& Task;
  Terms Seen;
  Index FilledVoxels;
  bool Warm;
  int Count = 0;
  double Change = 0;
  double BestEnergy = 0;
  std::vector<float> Current;
  std::vector<float> Next;
  std::vector<float> BestIterate;
  std::vector<float> Lagged; ///< T_L (V_L - g) of the last iterate
};
}

std::unique_ptr<Minimizer> MakePolicy(
  const Problem& problem, const Occupancy& occupancy, std::vector<float> start, bool warm)
{
  return std::make_unique<Policy>(problem, occupancy, std::move(start), warm);
}
}
