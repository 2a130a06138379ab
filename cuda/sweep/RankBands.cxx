// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/RankBands.h"

#include "sweep/SliceWindow.h"

#include <algorithm>
#include <numeric>

namespace limpid
{
namespace
{
/// What a row of rays costs: its samples that matter, the voxels beside it that may change, and a
/// little for itself.
std::vector<Index> CostsOfRows(const FaceFrustum& frustum)
{
  std::vector<Index> costs(std::size_t(frustum.rows), 1);
  for (int s = 0; s < frustum.lastSlice; ++s)
  {
    for (int row = 0; row < frustum.rows; ++row)
    {
      costs[std::size_t(row)] += std::max(frustum.ActiveRays(s, row).Length(), 0);
    }
  }
  for (int s = frustum.firstNodeSlice; s <= frustum.lastSlice; ++s)
  {
    const int* rows = frustum.Row(frustum.voxelRows, s).index;
    const Range<int>& owned = frustum.SliceAt(s).ownedRows;
    for (int v = owned.begin; v < owned.end; ++v)
    {
      costs[std::size_t(rows[v])] += std::max(frustum.FilledVoxels(s, v).Length(), 0);
    }
  }
  return costs;
}

/// Consecutive parts of about the same cost: where each begins, and the end.
std::vector<int> Divide(const std::vector<Index>& costs, int parts)
{
  const Index all = std::accumulate(costs.begin(), costs.end(), Index(0));
  std::vector<int> begins{ 0 };
  Index before = 0;
  for (std::size_t row = 0; row < costs.size(); ++row)
  {
    // A row belongs to the part that its middle lies in.
    const Index twice = 2 * before + costs[row];
    while (Index(begins.size()) < parts && twice * parts >= 2 * all * Index(begins.size()))
    {
      begins.push_back(static_cast<int>(row));
    }
    before += costs[row];
  }
  begins.resize(std::size_t(parts) + 1, static_cast<int>(costs.size()));
  return begins;
}
}

RankBands::RankBands(const FaceFrustum& frustum, const Communicator& ranks)
  : Frustum(frustum)
  , All(&ranks)
  , Begins(Divide(CostsOfRows(frustum), ranks.Size()))
{
  int last = 0;
  for (int s = 0; s < frustum.SliceCount(); ++s)
  {
    const Slice& slice = frustum.SliceAt(s);
    last = std::max({ last, slice.node, slice.nodes[0], slice.nodes[1] });
  }
  const auto depth = static_cast<std::size_t>(last) + 1;
  this->Needed.resize(std::size_t(ranks.Size()));
  for (int rank = 0; rank < ranks.Size(); ++rank)
  {
    std::vector<Range<int>>& rows = this->Needed[std::size_t(rank)];
    rows.resize(depth);
    const auto extend = [&rows](int node, const Range<int>& by)
    { rows[std::size_t(node)] = Hull(rows[std::size_t(node)], by); };
    for (int s = 0; s < frustum.SliceCount(); ++s)
    {
      const Slice& slice = frustum.SliceAt(s);
      if (s < frustum.lastSlice)
      {
        const Range<int> read = this->RowsRead(this->RaysOf(rank), s);
        extend(slice.nodes[0], read);
        extend(slice.nodes[1], read);
      }
      if (slice.node >= 0)
      {
        extend(slice.node, this->VoxelsOf(rank, s));
      }
    }
  }
}

/// Rows of voxels that rows of rays read in the layer behind slice `s`.
Range<int> RankBands::RowsRead(const Range<int>& rays, int s) const
{
  Range<int> read;
  for (int half = 0; half < 2 && !rays.Empty(); ++half)
  {
    const int* rows = this->Frustum.Row(this->Frustum.planeRows, 2 * s + half).index;
    read = Hull(read, { rows[rays.begin], rows[rays.end - 1] + 2 });
  }
  return read;
}

Range<int> RankBands::VoxelsOf(int rank, int s) const
{
  const Range<int> rays = this->RaysOf(rank);
  const int* rows = this->Frustum.Row(this->Frustum.voxelRows, s).index;
  const int* end = rows + this->Frustum.nodesV;
  const int* first = std::lower_bound(rows, end, rays.begin);
  const int* last = std::lower_bound(first, end, rays.end);
  const Range<int> beside{ static_cast<int>(first - rows), static_cast<int>(last - rows) };
  const Range<int> owned = Intersection(beside, this->Frustum.SliceAt(s).ownedRows);
  return owned.Empty() ? Range<int>{} : owned;
}

Range<int> RankBands::RaysReadBy(int rank, int s, int more) const
{
  const Range<int> voxels = this->VoxelsOf(rank, s);
  if (voxels.Empty())
  {
    return {};
  }
  // A voxel also reads what its neighbours do (VoxelRow::FindSeen).
  const int* rows = this->Frustum.Row(this->Frustum.voxelRows, s).index;
  const int first = rows[std::max(voxels.begin - 1, 0)];
  const int last = rows[std::min(voxels.end, this->Frustum.nodesV - 1)];
  return Intersection(Range<int>{ first - more, last + 2 + more }, { 0, this->Frustum.rows });
}

void RankBands::ExchangeRays(int s, int more, const std::vector<float*>& images) const
{
  const int own = this->All->Rank();
  std::vector<Communicator::Message> sent;
  std::vector<Communicator::Message> received;
  const auto add = [&](
                     std::vector<Communicator::Message>& messages, int rank, const Range<int>& rows)
  {
    for (float* image : rows.Empty() ? std::vector<float*>() : images)
    {
      const Index first = this->Frustum.RayAt(0, rows.begin);
      const Index count = Index(rows.Length()) * this->Frustum.columns;
      messages.push_back({ rank, image + first, std::size_t(count) * sizeof(float) });
    }
  };
  const Range<int> read = this->RaysReadBy(own, s, more);
  for (int rank = 0; rank < this->All->Size(); ++rank)
  {
    if (rank != own)
    {
      add(sent, rank, Intersection(this->RaysOf(own), this->RaysReadBy(rank, s, more)));
      add(received, rank, Intersection(this->RaysOf(rank), read));
    }
  }
  this->All->Exchange(sent, received);
}

void RankBands::ExchangeVoxels(int s, const std::vector<SliceWindow*>& fields) const
{
  const int own = this->All->Rank();
  const int node = this->Frustum.SliceAt(s).node;
  const Range<int>& columns = this->Frustum.SliceAt(s).ownedColumns;
  const std::size_t bytes = std::size_t(columns.Length()) * sizeof(float);
  std::vector<Communicator::Message> sent;
  std::vector<Communicator::Message> received;
  const auto add = [&](
                     std::vector<Communicator::Message>& messages, int rank, const Range<int>& rows)
  {
    for (SliceWindow* field : fields)
    {
      for (int v = rows.begin; v < rows.end; ++v)
      {
        messages.push_back({ rank, field->Row(node, v) + columns.begin, bytes });
      }
    }
  };
  for (int rank = 0; rank < this->All->Size(); ++rank)
  {
    if (rank != own)
    {
      add(sent, rank, Intersection(this->VoxelsOf(own, s), this->VoxelsNeeded(rank, node)));
      add(received, rank, Intersection(this->VoxelsOf(rank, s), this->VoxelsNeeded(own, node)));
    }
  }
  this->All->Exchange(sent, received);
}
}
