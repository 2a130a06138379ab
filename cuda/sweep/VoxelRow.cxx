// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/VoxelRow.h"

#include "backend/Backend.h"
#include "sweep/Cubic.h"
#include "sweep/HatMean.h"
#include "sweep/PlanOutline.h"
#include "sweep/Registers.h"
#include "sweep/RowInterpolation.h"

#include <algorithm>
#include <array>
#include <utility>

namespace limpid
{
namespace
{
/// A row of voxels between two rows of rays.
struct BetweenRows
{
  Index first[2];   ///< index of the ray in column 0 of the front row and of the next one
  float weights[2]; ///< weights of both

  /// `map`: map of the voxel rows; `share`: factor of both weights.
  BetweenRows(const FaceFrustum& frustum, const LinearMap& map, int v, float share)
    : first{ frustum.RayAt(0, map.index[v]), frustum.RayAt(0, map.index[v] + 1) }
    , weights{ share * (1.0f - map.weight[v]), share * map.weight[v] }
  {
  }
};

/// The images that voxels read.
struct RayImageRows
{
  const float* transmittance;
  const float* behind;
};

/// The two rows of rays around one row of voxels, with their weights.
struct RowsAbout
{
  const float* transmittance[2];
  const float* behind[2];
  float weights[2];

  LIMPID_INLINE RowsAbout(const RayImageRows& images, const BetweenRows& row)
    : transmittance{ images.transmittance + row.first[0], images.transmittance + row.first[1] }
    , behind{ images.behind + row.first[0], images.behind + row.first[1] }
    , weights{ row.weights[0], row.weights[1] }
  {
  }

  LIMPID_INLINE void Add(int i, float& passed, float& seen) const
  {
    const float first = this->weights[0] * this->transmittance[0][i];
    const float second = this->weights[1] * this->transmittance[1][i];
    passed += first + second;
    seen += first * this->behind[0][i] + second * this->behind[1][i];
  }
};

/// Interpolates the images to one row of voxels.
LIMPID_MULTIVERSION
void SeeRow(const RayImageRows& images, const BetweenRows& row, const Range<int>& columns,
  const SeenByVoxels& out)
{
  const RowsAbout own(images, row);
  float* __restrict transmittance = out.transmittance;
  float* __restrict behind = out.behind;
  LIMPID_IVDEP
  for (int i = columns.begin; i < columns.end; ++i)
  {
    float passed = 0;
    float seen = 0;
    own.Add(i, passed, seen);
    transmittance[i] = passed;
    behind[i] = seen;
  }
}

/// Interpolates and sums the images for three rows of voxels.
LIMPID_MULTIVERSION
void SeeRows(const RayImageRows& images, const std::array<BetweenRows, 3>& rows,
  const Range<int>& columns, const SeenByVoxels& out)
{
  const RowsAbout before(images, rows[0]);
  const RowsAbout own(images, rows[1]);
  const RowsAbout after(images, rows[2]);
  float* __restrict transmittance = out.transmittance;
  float* __restrict behind = out.behind;
  LIMPID_IVDEP
  for (int i = columns.begin; i < columns.end; ++i)
  {
    float passed = 0;
    float seen = 0;
    before.Add(i, passed, seen);
    own.Add(i, passed, seen);
    after.Add(i, passed, seen);
    transmittance[i] = passed;
    behind[i] = seen;
  }
}

LIMPID_MULTIVERSION
void AverageAlongRow(const float* __restrict values, const float* __restrict sides,
  const Range<int>& columns, float* __restrict out)
{
  for (int u = columns.begin; u < columns.end; ++u)
  {
    out[u] = HatMean(values[u - 1], values[u], values[u + 1], sides[u]);
  }
}

/// Replaces the mean transmittance and scales the importance behind accordingly.
LIMPID_MULTIVERSION
void ExchangeTransmittance(
  const float* __restrict other, const Range<int>& columns, const SeenByVoxels& seen)
{
  float* __restrict transmittance = seen.transmittance;
  float* __restrict behind = seen.behind;
  for (int u = columns.begin; u < columns.end; ++u)
  {
    behind[u] = Exchanged(behind[u], transmittance[u], other[u]);
    transmittance[u] = other[u];
  }
}

/// Interpolates and averages the rays in `read` across rows, for a row of voxels and its two
/// neighbours. `map`: map of the voxel rows; `side`: SideWeight of the row.
void SeeAcrossRows(const FaceFrustum& frustum, const LinearMap& map, int v, float side,
  const RayImageRows& images, const Range<int>& read, const SeenByVoxels& out)
{
  if (side == 0)
  {
    SeeRow(images, { frustum, map, v, 1.0f }, read, out);
    return;
  }
  SeeRows(images,
    { { { frustum, map, std::max(v - 1, 0), side }, { frustum, map, v, 1.0f - 2.0f * side },
      { frustum, map, std::min(v + 1, frustum.nodesV - 1), side } } },
    read, out);
}

LIMPID_MULTIVERSION
void AddRow(
  const float* __restrict values, float weight, const Range<int>& columns, float* __restrict sum)
{
  for (int i = columns.begin; i < columns.end; ++i)
  {
    sum[i] += weight * values[i];
  }
}

/// Multiplies values by shares. Guard rays, whose share is 0, may hold NaN.
LIMPID_MULTIVERSION
void WeighRow(float* __restrict values, const float* __restrict shares, const Range<int>& columns)
{
  for (int i = columns.begin; i < columns.end; ++i)
  {
    values[i] = shares[i] > 0.0f ? shares[i] * values[i] : 0.0f;
  }
}

/// Computes positions of rays on a slice, clamped to the box.
LIMPID_MULTIVERSION
void PlaceRow(const RayLine* __restrict lines, double relativeDepth, int nodes,
  const Range<int>& columns, float* __restrict positions)
{
  for (int i = columns.begin; i < columns.end; ++i)
  {
    positions[i] = static_cast<float>(InBox(lines[i].At(relativeDepth), nodes));
  }
}

/// Splits values of rays between the two voxels beside them, by the hat functions of these.
/// `positions`: see PlaceRow; `before`: in: the values; out: the parts of the voxels before the
/// rays.
LIMPID_MULTIVERSION
void SplitRow(const float* __restrict positions, const Range<int>& columns,
  float* __restrict before, float* __restrict behind)
{
  const int end = columns.end;
  for (int i = columns.begin; i < end; ++i)
  {
    const float position = positions[i];
    const float value = before[i];
    const auto voxel = static_cast<float>(static_cast<int>(position));
    before[i] = (1.0f - (position - voxel)) * value;
    behind[i] = (1.0f - ((voxel + 1.0f) - position)) * value;
  }
}

/// Sums what SplitRow has split at each voxel. Rays ascend, so that only two sums are open at a
/// time.
void SumPairs(const float* positions, const float* before, const float* behind,
  const Range<int>& rays, const Range<int>& voxels, float* sums)
{
  int voxel = voxels.begin - 1;
  float here = 0;
  float next = 0;
  const auto advanceTo = [&](int end) LIMPID_INLINE_LAMBDA
  {
    for (; voxel < end; ++voxel)
    {
      if (voxel >= voxels.begin)
      {
        sums[voxel] = here;
      }
      here = std::exchange(next, 0.0f);
    }
  };
  for (int i = rays.begin; i < rays.end; ++i)
  {
    const int place = static_cast<int>(positions[i]);
    advanceTo(std::min(place, voxels.end));
    if (place == voxel)
    {
      here += before[i];
      next += behind[i];
    }
  }
  advanceTo(voxels.end);
}

/// Multiplies by a common factor and one of each voxel.
LIMPID_MULTIVERSION
void ScaleRow(
  float* __restrict values, const float* __restrict factors, float factor, const Range<int>& voxels)
{
  const int end = voxels.end;
  for (int u = voxels.begin; u < end; ++u)
  {
    values[u] = factor * factors[u] * values[u];
  }
}

/// Turns density into transmittance, for voxels whose rays enter through a side.
struct TransmitFromDensity
{
  float depth;              ///< relative depth of the slice
  float rowEntry;           ///< relative depth where rays enter in v or through the front
  const float* columnEntry; ///< relative depth where rays enter in u
  float* values;

  LIMPID_INLINE void operator()(Index u) const
  {
    const float entry =
      this->rowEntry > this->columnEntry[u] ? this->rowEntry : this->columnEntry[u];
    this->values[u] = Transmitted(this->values[u] * (this->depth - entry));
  }
};

/// Returns the targets in `targets` whose four sources for a cubic are in `sources`.
Range<int> CubicTargets(const int* index, const Range<int>& targets, const Range<int>& sources)
{
  const int* first = index + targets.begin;
  const int* last = index + targets.end;
  const int* begin = std::lower_bound(first, last, sources.begin + 1);
  const int* end = std::lower_bound(begin, last, sources.end - 2);
  return { static_cast<int>(begin - index), static_cast<int>(end - index) };
}
}

VoxelRow::VoxelRow(const FaceFrustum& frustum, int s, int v)
  : Frustum(frustum)
  , Here(frustum.SliceAt(s))
  , S(s)
  , V(v)
  , Changing(frustum.FilledVoxels(s, v))
  , Active(frustum.ActiveVoxels(s, v))
{
  const auto nodes = std::size_t(frustum.nodesU);
  const std::size_t row = RowScratch(std::max(frustum.nodesU, frustum.columns));
  float* memory = ThreadScratch(3 * nodes + 3 * row + nodes + 2);
  this->Means = { memory, memory + nodes };
  this->Memory.importance = memory + 2 * nodes;
  for (std::size_t i = 0; i < 3; ++i)
  {
    this->Memory.rays[i] = memory + 3 * nodes + i * row;
  }
  this->Memory.voxels = memory + 3 * nodes + 3 * row + 1;
}

bool VoxelRow::FindSeen(const RaysBeside& rays)
{
  if (this->Active.Empty())
  {
    return false;
  }
  const SeenByVoxels alongRays{ this->Memory.rays[0], this->Memory.rays[1] };
  SeeAcrossRows(this->Frustum, this->Rows(), this->V,
    this->Frustum.Row(this->Frustum.rowSides, this->S)[this->V],
    { rays.transmittance, rays.behind }, this->RaysRead(this->Active), alongRays);
  this->AverageVoxels(alongRays.transmittance, this->Means.transmittance);
  this->AverageVoxels(alongRays.behind, this->Means.behind);
  const Range<int> front = this->BetweenFrontRays(this->Active);
  for (const Range<int>& side :
    { Range<int>{ this->Active.begin, front.begin }, Range<int>{ front.end, this->Active.end } })
  {
    this->TransmitFromSide(rays, side, this->Memory.voxels);
    ExchangeTransmittance(this->Memory.voxels, side, this->Means);
  }
  return true;
}

/// Returns the rays around all active columns.
Range<int> VoxelRow::ColumnsAboutActive() const
{
  return { this->Frustum.ColumnsAbout(this->S, this->Active.begin).begin,
    this->Frustum.ColumnsAbout(this->S, this->Active.end - 1).end };
}

bool VoxelRow::FindEffect(const RaysBeside& rays)
{
  if (this->Active.Empty())
  {
    return false;
  }
  const FaceFrustum& plan = this->Frustum;
  const float depth = this->Here.RelativeDepth();
  const Range<int> read = this->ColumnsAboutActive();
  const Range<int> rows = plan.RowsAbout(this->S, this->V);
  float* sum = this->Memory.rays[0];
  float* positions = this->Memory.rays[1];
  std::fill(sum + read.begin, sum + read.end, 0.0f);
  for (int row = rows.begin; row < rows.end; ++row)
  {
    const float weight = plan.Row(plan.rowShare)[row] *
      HatAt(plan.Row(plan.rowLines)[row].At(depth), this->V, plan.nodesV);
    if (weight > 0)
    {
      AddRow(rays.behind + plan.RayAt(0, row), weight, read, sum);
    }
  }
  WeighRow(sum, plan.Row(plan.columnShare), read);
  PlaceRow(plan.Row(plan.columnLines), depth, plan.nodesU, read, positions);
  SplitRow(positions, read, sum, this->Memory.rays[2]);
  SumPairs(positions, sum, this->Memory.rays[2], read, this->Active, this->Means.behind);
  const float gain = this->Here.hatGain * plan.Row(plan.rowHatGain, this->S)[this->V];
  ScaleRow(this->Means.behind, plan.Row(plan.columnHatGain, this->S), gain, this->Active);
  return true;
}

const float* VoxelRow::ImportanceInView(Field nodeImportance)
{
  const float* importance = this->Row(nodeImportance);
  if (this->Frustum.seesAll)
  {
    return importance;
  }
  this->SampleRays(this->Frustum.Row(this->Frustum.inView), this->Active, this->Memory.importance);
  MultiplyRow(this->Memory.importance, importance, this->Active);
  return this->Memory.importance;
}

void VoxelRow::FindTransmittance(const RaysBeside& rays, float* transmittance)
{
  const Range<int> owned = this->Here.ownedColumns;
  const float depth = this->Here.RelativeDepth();
  // In front of its entry into the box a ray has no values suitable for a cubic of four rays.
  const LinearMap map = this->Columns();
  const int row = this->Rows().index[this->V];
  const Range<int> rows = RaysEnteredBy(this->Frustum.Row(this->Frustum.rowEntry),
    Intersection(this->Here.rayRows, { 1, this->Frustum.rows - 1 }), depth);
  const Range<int> cubic = row > rows.begin && row + 2 < rows.end
    ? CubicTargets(map.index, owned,
        RaysEnteredBy(this->Frustum.Row(this->Frustum.columnEntry),
          Intersection(this->Here.rayColumns, { 1, this->Frustum.columns - 1 }), depth))
    : Range<int>{};
  if (cubic.Empty())
  {
    this->TransmitLinear(rays, owned, transmittance);
    return;
  }
  const Range<int>& frontRows = this->Frustum.frontRows;
  const Range<int> front = row > frontRows.begin && row + 2 < frontRows.end
    ? CubicTargets(map.index, cubic, this->Frustum.frontColumns)
    : Range<int>{ cubic.end, cubic.end };
  this->TransmitLinear(rays, { owned.begin, cubic.begin }, transmittance);
  for (const Range<int>& side :
    { Range<int>{ cubic.begin, front.begin }, Range<int>{ front.end, cubic.end } })
  {
    this->SampleCubic(rays.density, side, transmittance);
    this->TransmitDensity(side, transmittance);
  }
  this->SampleCubic(rays.transmittance, front, transmittance);
  ClampRow(front, transmittance);
  this->TransmitLinear(rays, { cubic.end, owned.end }, transmittance);
}

/// Returns the rays that a range of voxel columns and their neighbours interpolate.
Range<int> VoxelRow::RaysRead(const Range<int>& columns) const
{
  const int* index = this->Columns().index;
  const int first = std::max(columns.begin - 1, 0);
  const int last = std::min(columns.end, this->Frustum.nodesU - 1);
  return WholeRegisters({ index[first], index[last] + 2 }, this->Here.rayColumns);
}

/// Returns the part of `columns` between rays that enter in front. If there is none, the returned
/// range starts and ends at the end of `columns`.
Range<int> VoxelRow::BetweenFrontRays(const Range<int>& columns) const
{
  const int row = this->Rows().index[this->V];
  // Both rays of a voxel must enter in front.
  const Range<int> front = Intersection(columns,
    { this->Frustum.FirstVoxel(this->S, this->Frustum.frontColumns.begin),
      this->Frustum.FirstVoxel(this->S, this->Frustum.frontColumns.end - 1) });
  const bool rowInFront =
    row >= this->Frustum.frontRows.begin && row + 1 < this->Frustum.frontRows.end;
  return rowInFront && !front.Empty() ? front : Range<int>{ columns.end, columns.end };
}

void VoxelRow::SampleRays(const float* image, const Range<int>& columns, float* out)
{
  if (columns.Empty())
  {
    return;
  }
  const LinearMap map = this->Columns();
  const Range<int> read = WholeRegisters(
    { map.index[columns.begin], map.index[columns.end - 1] + 2 }, this->Here.rayColumns);
  const int row = this->Rows().index[this->V];
  BlendRows(image + this->Frustum.RayAt(0, row), image + this->Frustum.RayAt(0, row + 1),
    this->Rows().weight[this->V], read.begin, read.end, this->Memory.rays[0]);
  InterpolateRow(this->Memory.rays[0], map, columns, out);
}

/// Interpolates an image of the rays by cubics.
void VoxelRow::SampleCubic(const float* image, const Range<int>& columns, float* out)
{
  if (columns.Empty())
  {
    return;
  }
  const LinearMap map = this->Columns();
  const int begin = map.index[columns.begin];
  const int end = map.index[columns.end - 1] + 2;
  float* const blend = this->Memory.rays[0];
  float* const curvature = this->Memory.rays[1];
  float* const bend = this->Memory.rays[2];
  const float* rows[4];
  for (int i = 0; i < 4; ++i)
  {
    rows[i] = image + this->Frustum.RayAt(0, this->Rows().index[this->V] - 1 + i);
  }
  BlendCubic(rows, this->Rows().weight[this->V], begin - 1, end + 1, blend);
  Curve(blend, begin, end, curvature);
  InterpolateRow(blend, map, columns, out);
  InterpolateRow(curvature, map, columns, bend);
  BendRow(map, bend, columns, out);
}

void VoxelRow::TransmitFromSide(const RaysBeside& rays, const Range<int>& columns, float* out)
{
  this->SampleRays(rays.density, columns, out);
  this->TransmitDensity(columns, out);
}

/// Interpolates transmittance linearly. Between rays that enter through a side, it is computed
/// from their density, using the entry of the voxel's own ray.
void VoxelRow::TransmitLinear(const RaysBeside& rays, const Range<int>& columns, float* out)
{
  const Range<int> front = this->BetweenFrontRays(columns);
  this->TransmitFromSide(rays, { columns.begin, front.begin }, out);
  this->SampleRays(rays.transmittance, front, out);
  this->TransmitFromSide(rays, { front.end, columns.end }, out);
}

void VoxelRow::TransmitDensity(const Range<int>& columns, float* densityToTransmittance) const
{
  const float rowEntry = this->Frustum.Row(this->Frustum.voxelRowEntry, this->S)[this->V];
  detail::StepAlongRow(columns,
    TransmitFromDensity{ this->Here.RelativeDepth(), std::max(rowEntry, this->Frustum.frontDepth),
      this->Frustum.Row(this->Frustum.voxelColumnEntry, this->S), densityToTransmittance });
}

/// Interpolates a row of rays to the active voxels and averages the result along the row.
void VoxelRow::AverageVoxels(const float* rays, float* out)
{
  const int nodes = this->Frustum.nodesU;
  float* voxels = this->Memory.voxels;
  const Range<int> wide{ std::max(this->Active.begin - 1, 0),
    std::min(this->Active.end + 1, nodes) };
  InterpolateRow(rays, this->Columns(), wide, voxels);
  voxels[-1] = voxels[0];
  voxels[nodes] = voxels[nodes - 1];
  AverageAlongRow(voxels, this->Frustum.Row(this->Frustum.columnSides, this->S), this->Active, out);
}
}
