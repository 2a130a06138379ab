// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/SlopeSampler.h"

#include "sweep/Registers.h"
#include "sweep/RowInterpolation.h"

#include <algorithm>

namespace limpid
{
namespace
{
constexpr int edgesMore = 3; // number of edges minus number of rays

/// out = (0 or out) + factor (front + along (back - front)), for columns [begin, end).
LIMPID_MULTIVERSION
void AddRow(const float* __restrict front, const float* __restrict back, float along, float factor,
  bool first, int begin, int end, float* __restrict out)
{
  for (int u = begin; u < end; ++u)
  {
    out[u] = (first ? 0.0f : out[u]) + factor * (front[u] + along * (back[u] - front[u]));
  }
}

/// out[i] = factor times the sum of samples[i], ..., samples[i + 3], with the weights of column i.
LIMPID_MULTIVERSION
void DifferRow(const float* __restrict samples, const float* const weights[4], float factor,
  const Range<int>& columns, float* __restrict out)
{
  const float* __restrict first = weights[0];
  const float* __restrict second = weights[1];
  const float* __restrict third = weights[2];
  const float* __restrict fourth = weights[3];
  for (int i = columns.begin; i < columns.end; ++i)
  {
    out[i] = factor *
      (first[i] * samples[i] + second[i] * samples[i + 1] + third[i] * samples[i + 2] +
        fourth[i] * samples[i + 3]);
  }
}

/// Returns the weight of a row of voxels in the sum over four edges between rows of rays, each
/// with its own factor.
float FactorOf(int voxelRow, const LinearMap& edges, const float factors[4])
{
  float sum = 0;
  for (int k = 0; k < 4; ++k)
  {
    const float before = voxelRow == edges.index[k] ? 1 - edges.weight[k] : 0.0f;
    const float behind = voxelRow == edges.index[k] + 1 ? edges.weight[k] : 0.0f;
    sum += factors[k] * (before + behind);
  }
  return sum;
}
}

/// A plane for this row of rays.
struct SlopeRowSampler::Plane
{
  const int* nodes; ///< node indices of both slices of the layer
  float fraction;   ///< weight of the second slice
  float perIndex;   ///< ray coordinate per index
  int voxelRow;
  float across; ///< weight of the next row of voxels
  LinearMap columns;
  LinearMap columnEdges;
  LinearMap rowEdges; ///< starting at this row's first edge
};

SlopeRowSampler::SlopeRowSampler(const FaceFrustum& frustum, const RayStates& states, int row)
  : RowSampler(frustum, states, row,
      9 * std::size_t(frustum.columns + edgesMore) +
        RowScratch(std::max(frustum.nodesU, frustum.columns)))
{
  float* room = this->More;
  for (auto& pair : this->Values)
  {
    for (float*& values : pair)
    {
      values = room;
      room += frustum.columns + edgesMore;
    }
  }
  this->Edges = room;
  this->Blended = room + frustum.columns + edgesMore;
  for (int half = 0; half < 2; ++half)
  {
    this->Rays.importance[half] = this->Values[0][half];
    this->Rays.extinction[half] = this->Values[1][half];
    this->Differences.across[half] = this->Values[2][half];
    this->Differences.down[half] = this->Values[3][half];
  }
}

void SlopeRowSampler::EnterPart(const ViewDerivativePlan& plan, int part)
{
  this->Sampled = &plan;
  this->Part = part;
  this->Rays.layer = PartOf(this->Frustum.SliceAt(this->S).layer, part, plan.parts);
}

void SlopeRowSampler::SampleImportance(Field field)
{
  for (int half = 0; half < 2; ++half)
  {
    const Plane plane = this->PlaneAt(half);
    this->Blend(field, plane, this->ReadBy(plane, field));
    InterpolateRow(this->Blended, plane.columns, this->Rays.columns, this->Values[0][half]);
  }
}

void SlopeRowSampler::SampleExtinctionAndSlopes(Field field)
{
  const Range<int>& rays = this->Rays.columns;
  const ViewDerivativePlan& plan = *this->Sampled;
  for (int half = 0; half < 2; ++half)
  {
    const Plane plane = this->PlaneAt(half);
    const Range<int> read = this->ReadBy(plane, field);
    this->Blend(field, plane, read);
    InterpolateRow(this->Blended, plane.columns, rays, this->Values[1][half]);
    InterpolateRow(
      this->Blended, plane.columnEdges, { rays.begin, rays.end + edgesMore }, this->Edges);
    const float* weights[4];
    for (int k = 0; k < 4; ++k)
    {
      weights[k] = plan.Row(plan.columnStencil, k);
    }
    DifferRow(this->Edges, weights, plane.perIndex, rays, this->Values[2][half]);
    this->BlendDifference(field, plane, read);
    InterpolateRow(this->Blended, plane.columns, rays, this->Values[3][half]);
  }
}

SlopeRowSampler::Plane SlopeRowSampler::PlaneAt(int half) const
{
  const ViewDerivativePlan& plan = *this->Sampled;
  const Index number = plan.PlaneOf(this->S, this->Part, half);
  const Slice& slice = this->Frustum.SliceAt(this->S);
  const LinearMap rows = plan.MapOf(plan.rows, number, slice.rayRows);
  const LinearMap edges = plan.MapOf(plan.rowEdges, number, slice.rayRows);
  const int row = this->RowNumber;
  return { slice.nodes, plan.Row(plan.fractions)[number], plan.Row(plan.perIndex)[number],
    rows.index[row], rows.weight[row], plan.MapOf(plan.columns, number, slice.rayColumns),
    plan.MapOf(plan.columnEdges, number, slice.rayColumns),
    { edges.index + row, edges.weight + row } };
}

/// Returns the voxel columns that rays and the edges between them read.
Range<int> SlopeRowSampler::ReadBy(const Plane& plane, Field field) const
{
  const int* edges = plane.columnEdges.index;
  return WholeRegisters(
    { edges[this->Rays.columns.begin], edges[this->Rays.columns.end + edgesMore - 1] + 2 },
    { 0, field->columns });
}

void SlopeRowSampler::Blend(Field field, const Plane& plane, const Range<int>& read)
{
  const int v = plane.voxelRow;
  const float* rows[2][2] = { { field->Row(plane.nodes[0], v), field->Row(plane.nodes[0], v + 1) },
    { field->Row(plane.nodes[1], v), field->Row(plane.nodes[1], v + 1) } };
  BlendFourRows(rows, plane.across, plane.fraction, read.begin, read.end, this->Blended);
}

/// Computes the derivative across rows for a range of voxel columns.
void SlopeRowSampler::BlendDifference(Field field, const Plane& plane, const Range<int>& read)
{
  float factors[4];
  for (int k = 0; k < 4; ++k)
  {
    factors[k] = this->Sampled->Row(this->Sampled->rowStencil, k)[this->RowNumber] * plane.perIndex;
  }
  const int first = plane.rowEdges.index[0];
  for (int v = first; v <= plane.rowEdges.index[3] + 1; ++v)
  {
    AddRow(field->Row(plane.nodes[0], v), field->Row(plane.nodes[1], v), plane.fraction,
      FactorOf(v, plane.rowEdges, factors), v == first, read.begin, read.end, this->Blended);
  }
}
}
