// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/PolicySweep.h"

#include "energy/GradientVoxel.h"
#include "sweep/RayMeans.h"
#include "sweep/Registers.h"

#include <algorithm>

namespace limpid
{
namespace
{
/// The voxels of one row. All arrays are indexed by column.
struct PolicyRowArrays
{
  const float* transmittance; ///< [0, 1]
  const float* behind;        ///< what transmittance leaves of it [scale^2]
  const float* importance;    ///< [0, 1]
  const float* base;          ///< [1/length]
  const float* lagged;        ///< T (V - g) of the other term; null: none
  float* extinction;          ///< out [1/length]
};

LIMPID_MULTIVERSION
void PolicyRow(const PolicyVoxel<float>& policy, const GradientVoxel<float>& gradient,
  const PolicyRowArrays& arrays, const Range<int>& columns)
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
  const PolicyVoxel<float>& policy, const PolicyRowArrays& arrays, const Range<int>& columns)
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

/// The backward sweep of one frustum.
class PolicyVisitor
{
public:
  PolicyVisitor(const FaceFrustum& frustum, const PolicyTask& task, RayImages& images)
    : Source(frustum)
    , Occupied(*task.occupancy)
    , Images(images)
    , Voxel(task.voxel)
    , TrustTransmittance(task.trust == Trust::LastIterate)
    , Widens(task.derivative == Derivative::Volume)
    , HasLagged(task.fields.lagged != nullptr)
    , Base(frustum, *task.grid, task.fields.base, images.slabs, task.occupancy)
    , Importance(frustum, *task.grid, task.fields.importance, images.slabs, task.occupancy)
    , NodeImportance(frustum, *task.grid, task.fields.nodeImportance, images.slabs, task.occupancy)
    , Extinction(frustum, *task.grid, task.fields.extinction, images.slabs, task.occupancy)
    , Lagged(frustum, *task.grid, task.fields.lagged, images.slabs, task.occupancy)
    , Next(frustum, *task.grid, task.fields.next, images.slabs, task.occupancy)
    , Ahead(images.behind.size(), 0.0f)
    , RearImportance(images.behind.size(), 0.0f)
    , Collected(images.opticalDepth.size(), 0.0)
    , Moved(std::size_t(frustum.nodesV))
  {
    StartBehind(images);
  }

  void Load(const Range<int>& slab)
  {
    this->Base.Load(slab, 0);
    this->NodeImportance.Load(slab, 0);
    this->Importance.Load(slab, 2);
    this->Next.Load(slab, 2);
    this->Extinction.Load(slab, 1);
    if (this->HasLagged)
    {
      this->Lagged.Load(slab, 0);
    }
  }

  void Store(const Range<int>& slab) { this->Next.Store(slab); }

  /// Moves a row of rays to slice `s`, whose voxels are to be found next. The voxels behind are
  /// final.
  void RayRow(int s, int row)
  {
    float* memory = ThreadScratch(LayerMemory(this->Source));
    const int last = this->Source.LastSlice();
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

  /// Moves a row of rays from the first slice of voxels out of the volume.
  void Leave(int row)
  {
    for (int s = std::min(this->Source.FirstNodeSlice(), this->Source.LastSlice() - 1); s >= 0; --s)
    {
      this->CarryThroughLayer(s, row, ThreadScratch(LayerMemory(this->Source)));
    }
  }

  /// When the sweep is through.
  PolicyFound Finish()
  {
    this->Images.opticalDepth.swap(this->Collected);
    PolicyFound found{ SumBehind(this->Source, this->Images), {} };
    for (const Differences& row : this->Moved)
    {
      found.moved += row;
    }
    return found;
  }

  void VoxelRow(int s, int v)
  {
    const Slice& slice = this->Source.slices[std::size_t(s)];
    const Range<int> filled = SpansOf(this->Source, this->Occupied, slice.node, v).filled;
    const Range<int> owned =
      WholeRegisters(Intersection(slice.ownedColumns, filled), slice.ownedColumns);
    if (owned.Empty())
    {
      return;
    }
    this->Prefetch(slice.node, v + 1, owned);
    this->FindVoxels(s, v, owned);
    // While they are at hand: the energy and the change need not read them again.
    const float* next = this->Next.Row(slice.node, v) + owned.begin;
    const float* base = this->Base.Row(slice.node, v) + owned.begin;
    const float* last = this->Extinction.Row(slice.node, v) + owned.begin;
    const Index count = owned.end - owned.begin;
    this->Moved[std::size_t(v)] +=
      { SumOfSquares(next, base, count), SumOfChanges(next, last, count) };
  }

private:
  void FindVoxels(int s, int v, const Range<int>& owned)
  {
    const Slice& slice = this->Source.slices[std::size_t(s)];
    const Range<int> columns =
      WholeRegisters(Intersection(this->Source.VoxelColumns(slice, v), owned), owned);
    PolicyRowArrays arrays{};
    arrays.base = this->Base.Row(slice.node, v);
    arrays.lagged = this->HasLagged ? this->Lagged.Row(slice.node, v) : nullptr;
    arrays.extinction = this->Next.Row(slice.node, v);
    if (columns.Empty())
    {
      LaggedRow(this->Voxel, arrays, owned);
      return;
    }
    LaggedRow(this->Voxel, arrays, { owned.begin, columns.begin });
    LaggedRow(this->Voxel, arrays, { columns.end, owned.end });

    const auto nodes = std::size_t(this->Source.nodesU);
    float* memory = ThreadScratch(3 * nodes + MeanScratch(this->Source));
    float* scratch = memory + 3 * nodes;
    AverageSeen(this->Source, slice, v, columns, this->Images, this->Ahead, scratch,
      { memory, memory + nodes });
    arrays.transmittance = memory;
    arrays.behind = memory + nodes;
    arrays.importance = this->NodeImportance.Row(slice.node, v);
    if (!this->Source.inView.empty())
    {
      float* seen = memory + 2 * nodes;
      SampleRays(this->Source, slice, v, columns, this->Source.inView, scratch, seen);
      MultiplyRow(seen, arrays.importance, columns);
      arrays.importance = seen;
    }
    const float area = this->Widens ? slice.scale * slice.scale : 1.0f;
    PolicyRow(this->Voxel, { 1.0f / area }, arrays, columns);
  }

  LIMPID_INLINE void Prefetch(int node, int v, const Range<int>& columns)
  {
    for (SliceWindow* field : { &this->Base, &this->NodeImportance, &this->Next })
    {
      field->Prefetch(node, v, columns);
    }
    if (this->HasLagged)
    {
      this->Lagged.Prefetch(node, v, columns);
    }
  }

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
    return this->Source.slices[std::size_t(s)].planes[std::size_t(half)];
  }

  /// Visible importance of a row of rays from the back of layer `s` to its front.
  void CarryThroughLayer(int s, int row, float* memory)
  {
    const auto columns = std::size_t(this->Source.columns);
    float* scratch = memory + 4 * columns;
    limpid::RayRow rays = this->Rays(s, row);
    if (rays.work.Empty())
    {
      return;
    }
    SampleExtinction(this->Source, s, row, this->Next, memory, rays);
    float* front = memory + 2 * columns;
    float* rear = this->RearImportance.data() + std::size_t(row) * columns;
    this->SampleImportance(this->PlaneAt(s, 0), row, rays.work, scratch, front);
    if (s < this->Source.FirstNodeSlice()) // elsewhere LookAhead has done it
    {
      this->SampleImportance(this->PlaneAt(s, 1), row, rays.work, scratch, rear);
    }
    rays.importance[0] = front;
    rays.importance[1] = rear;
    RaysBehind state = this->Images.Behind(this->Source, row);
    state.opticalDepth = this->Collected.data() + std::size_t(row) * columns;
    CollectRow(rays, state);
  }

  /// Visible importance in the middle of layer `s`. The rear half of the layer is taken to be as
  /// opaque as the slice behind it, as the slice in front is not known yet.
  void LookAhead(int s, int row, float* memory)
  {
    const std::size_t columns = std::size_t(this->Source.columns);
    float* scratch = memory + 4 * columns;
    limpid::RayRow rays = this->Rays(s, row);
    if (rays.work.Empty())
    {
      return;
    }
    const Plane& plane = this->PlaneAt(s, 1);
    SamplePlane(plane, row, rays.work, SliceBlend::RearAlone, this->Next, scratch, memory);
    float* importance = this->RearImportance.data() + std::size_t(row) * columns;
    this->SampleImportance(plane, row, rays.work, scratch, importance);
    rays.extinction[0] = rays.extinction[1] = memory;
    rays.importance[0] = rays.importance[1] = importance;
    RearHalfRow(rays, this->Images.behind.data() + std::size_t(row) * columns,
      this->Ahead.data() + std::size_t(row) * columns);
  }

  void SampleImportance(
    const Plane& plane, int row, const Range<int>& columns, float* scratch, float* out)
  {
    SamplePlane(plane, row, columns, SliceBlend::Both, this->Importance, scratch, out);
    HideOutOfView(this->Source, row, columns, out);
  }

  /// Transmittance on slice `s` through the last iterate.
  void UnwindTransmittance(int s, int row, float* memory)
  {
    const Range<int>& work = this->Source.slices[std::size_t(s)].work[std::size_t(row)];
    if (work.Empty())
    {
      return;
    }
    const std::size_t columns = std::size_t(this->Source.columns);
    double* opticalDepth = this->Images.opticalDepth.data() + std::size_t(row) * columns;
    const bool last = s == this->Source.LastSlice();
    if (!last)
    {
      limpid::RayRow rays = this->Rays(s, row);
      SampleExtinction(this->Source, s, row, this->Extinction, memory, rays);
      UnwindRow(rays, opticalDepth);
    }
    TransmitRays(
      this->Source, s, row, work, last ? nullptr : memory, Depths::Unwound, this->Images);
  }

  const FaceFrustum& Source;
  const Occupancy& Occupied;
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
  std::vector<float> Ahead;          ///< visible importance half way to the slice behind
  std::vector<float> RearImportance; ///< sampled by LookAhead for CarryThroughLayer
  std::vector<double> Collected;     ///< optical depth of the layers carried through
  std::vector<Differences> Moved;    ///< per voxel row, of all slices
};
}

PolicyTask TaskOf(const Problem& problem, double weight, double lagWeight)
{
  // Without regularisation the optimum is bang-bang, which a large but finite gain gives, too.
  const double p = std::max(problem.RegularizationWeight(), 1e-30);
  const auto gainOf = [p](double w) { return static_cast<float>(std::min(w / p, 1e30)); };
  PolicyTask task{};
  task.grid = &problem.grid;
  task.occupancy = problem.occupancy.get();
  task.voxel.gain = gainOf(weight);
  task.voxel.lagGain = gainOf(lagWeight);
  task.voxel.majorant = problem.majorant;
  task.fields.base = problem.baseExtinction;
  task.fields.importance = problem.importance;
  task.fields.nodeImportance = problem.nodeImportance;
  task.derivative = problem.settings.derivative;
  return task;
}

PolicyFound SweepPolicy(const FaceFrustum& frustum, const PolicyTask& task, RayImages& images)
{
  PolicyVisitor visitor(frustum, task, images);
  SweepBackward(frustum, visitor);
  return visitor.Finish();
}
}
