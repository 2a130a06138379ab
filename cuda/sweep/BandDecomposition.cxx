// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/BandDecomposition.h"

#include "distributed/PackedExchange.h"
#include "sweep/SliceWindow.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace limpid
{
BandDecomposition::BandDecomposition(const FaceFrustum& frustum, const Communicator& ranks)
  : Frustum(frustum)
  , All(&ranks)
  , SlicesPerStretch(slicesPerStretch)
{
  if (ranks.IsAlone())
  {
    this->TakeAll();
    return;
  }
  this->Begins = FindEvenBands(frustum, ranks.Size());
  this->FindNeeded();
  this->FindVisited();
  for (int s = 0; s < frustum.SliceCount(); ++s)
  {
    const bool voxels = frustum.HasVoxels() && frustum.SliceAt(s).node >= 0;
    this->Reached = Hull(this->Reached, this->RaysOf(ranks.Rank(), s));
    if (voxels)
    {
      this->Reached = Hull(this->Reached, this->RaysReadBy(ranks.Rank(), s, 1));
    }
    const auto rays = [this, s](int rank) { return this->RaysOf(rank, s); };
    for (const int more : { 0, 1 })
    {
      const auto read = [&](int rank) { return this->RaysReadBy(rank, s, more); };
      this->Rays[more].push_back(voxels ? this->Pass(rays, read) : OnSlice());
    }
    const auto changed = [&](int rank) { return this->VoxelsOf(rank, s); };
    const auto needed = [&](int rank) { return this->VoxelsNeeded(rank, frustum.SliceAt(s).node); };
    this->Voxels.push_back(voxels ? this->Pass(changed, needed) : OnSlice());
  }
}

/// Gives all rows to the only rank.
void BandDecomposition::TakeAll()
{
  const auto slices = static_cast<std::size_t>(this->Frustum.SliceCount());
  this->SlicesPerStretch = this->Frustum.SliceCount();
  this->Begins = { { 0, this->Frustum.rows } };
  this->Needed.emplace_back(
    std::size_t(this->NodesReached()), Range<int>{ 0, this->Frustum.nodesV });
  this->Reached = { 0, this->Frustum.rows };
  this->Rays[0].resize(slices);
  this->Rays[1].resize(slices);
  this->Voxels.resize(slices);
}

/// Returns the number of nodes along the depth axis that the frustum reaches.
int BandDecomposition::NodesReached() const
{
  int last = 0;
  for (int s = 0; s < this->Frustum.SliceCount(); ++s)
  {
    const Slice& slice = this->Frustum.SliceAt(s);
    last = std::max({ last, slice.node, slice.nodes[0], slice.nodes[1] });
  }
  return last + 1;
}

void BandDecomposition::FindNeeded()
{
  const auto nodes = static_cast<std::size_t>(this->NodesReached());
  for (int rank = 0; rank < this->All->Size(); ++rank)
  {
    std::vector<Range<int>> rows(nodes);
    const auto extend = [&rows](int node, const Range<int>& by)
    { rows[std::size_t(node)] = Hull(rows[std::size_t(node)], by); };
    for (int s = 0; s < this->Frustum.SliceCount(); ++s)
    {
      // Back-to-front sweeps also carry rays through the layer behind the next slice, whose voxels
      // are final by then, or through the layer in front.
      for (int layer = std::max(s - 1, 0); layer < std::min(s + 2, this->Frustum.lastSlice);
           ++layer)
      {
        const Range<int> read = this->RowsRead(this->RaysOf(rank, s), layer);
        extend(this->Frustum.SliceAt(layer).nodes[0], read);
        extend(this->Frustum.SliceAt(layer).nodes[1], read);
      }
      if (this->Frustum.SliceAt(s).node >= 0)
      {
        extend(this->Frustum.SliceAt(s).node, this->VoxelsOf(rank, s));
      }
    }
    this->Needed.push_back(std::move(rows));
  }
}

void BandDecomposition::FindVisited()
{
  this->Visited.resize(std::size_t(this->Frustum.rows));
  for (int s = 0; s < this->Frustum.lastSlice; ++s)
  {
    const Range<int>& near = this->Frustum.SliceAt(s).rayRows;
    for (int row = near.begin; row < near.end; ++row)
    {
      Range<int>& columns = this->Visited[std::size_t(row)];
      columns = Hull(columns, this->Frustum.ActiveRays(s, row));
    }
  }
}

/// Returns the messages between this rank and all others, from what each rank has and reads.
template <class Had, class Read>
BandDecomposition::OnSlice BandDecomposition::Pass(const Had& had, const Read& read) const
{
  OnSlice passing;
  const int own = this->All->Rank();
  for (int other = 0; other < this->All->Size(); ++other)
  {
    const auto add = [other](const Range<int>& rows, std::vector<RowMessage>& all)
    {
      if (!rows.Empty())
      {
        all.push_back({ other, rows });
      }
    };
    if (other != own)
    {
      add(Intersection(had(own), read(other)), passing.sent);
      add(Intersection(had(other), read(own)), passing.received);
    }
  }
  return passing;
}

/// Returns the rows of voxels that rows of rays read in the layer behind slice `s`, including the
/// samples of resolved layers (ResolvedRay).
Range<int> BandDecomposition::RowsRead(const Range<int>& rays, int s) const
{
  Range<int> read;
  const Range<int> near = Intersection(rays, this->Frustum.SliceAt(s).rayRows);
  for (int half = 0; half < 2 && !near.Empty(); ++half)
  {
    const int* rows = this->Frustum.PlaneRows(2 * s + half).index;
    read = Hull(read, { rows[near.begin], rows[near.end - 1] + 2 });
  }
  return read.Empty() ? read : Grown(read, 1, this->Frustum.nodesV);
}

Range<int> BandDecomposition::VoxelsOf(int rank, int s) const
{
  if (!this->Frustum.HasVoxels())
  {
    return {};
  }
  const Range<int> rays = this->RaysOf(rank, s);
  const int* rows = this->Frustum.Row(this->Frustum.voxelRows, s).index;
  const int* end = rows + this->Frustum.nodesV;
  const int* first = std::lower_bound(rows, end, rays.begin);
  const int* last = std::lower_bound(first, end, rays.end);
  const Range<int> beside{ static_cast<int>(first - rows), static_cast<int>(last - rows) };
  const Range<int> owned = Intersection(beside, this->Frustum.SliceAt(s).ownedRows);
  return owned.Empty() ? Range<int>{} : owned;
}

/// Returns the rows of rays that voxels of a rank read on slice `s`, and `more` rows on either
/// side.
Range<int> BandDecomposition::RaysReadBy(int rank, int s, int more) const
{
  const Range<int> voxels = this->VoxelsOf(rank, s);
  if (voxels.Empty())
  {
    return {};
  }
  // A voxel also reads what its neighbours read (VoxelRow::FindSeen).
  const Range<int> about{ this->Frustum.RowsAbout(s, voxels.begin).begin,
    this->Frustum.RowsAbout(s, voxels.end - 1).end };
  return Intersection(
    Range<int>{ about.begin - more, about.end + more }, { 0, this->Frustum.rows });
}

namespace
{
/// Adds a box, or extends the last one if the box continues it along an axis.
void Add(const NodeBox& box, int axis, Region& region)
{
  if (box.Empty())
  {
    return;
  }
  const auto along = std::size_t(axis);
  if (!region.empty())
  {
    NodeBox joined = region.back();
    Range<int>& depth = joined.along[along];
    const Range<int>& next = box.along[along];
    const bool before = next.end == depth.begin;
    if (before || next.begin == depth.end)
    {
      depth = before ? Range<int>{ next.begin, depth.end } : Range<int>{ depth.begin, next.end };
      bool goesOn = true;
      for (std::size_t other = 0; other < 3; ++other)
      {
        const Range<int>& one = joined.along[other];
        const Range<int>& two = box.along[other];
        goesOn = goesOn && (other == along || (one.begin == two.begin && one.end == two.end));
      }
      if (goesOn)
      {
        region.back() = joined;
        return;
      }
    }
  }
  region.push_back(box);
}

/// Contiguous values in memory.
struct Segment
{
  std::byte* first;
  std::size_t bytes;
};

/// Adds a range of columns of a row; empty ranges are skipped.
void AddSegment(const RayValues& values, Index beginOfRow, const Range<int>& columns,
  std::vector<Segment>& segments)
{
  if (!columns.Empty())
  {
    segments.push_back({ values.first + std::size_t(beginOfRow + columns.begin) * values.bytes,
      std::size_t(columns.Length()) * values.bytes });
  }
}

using Segments = std::vector<Segment>;

std::vector<std::size_t> BytesOf(const std::vector<Segments>& messages)
{
  std::vector<std::size_t> bytes;
  bytes.reserve(messages.size());
  for (const Segments& message : messages)
  {
    bytes.push_back(std::accumulate(message.begin(), message.end(), std::size_t(0),
      [](std::size_t sum, const Segment& segment) { return sum + segment.bytes; }));
  }
  return bytes;
}
}

/// `add`: appends the values of a row to the segments of a message.
template <class Add>
void BandDecomposition::Exchange(const OnSlice& passing, const Add& add) const
{
  const auto messagesOf = [&](const std::vector<RowMessage>& all)
  {
    std::vector<Segments> messages(std::size_t(this->All->Size()));
    for (const RowMessage& some : all)
    {
      for (int row = some.rows.begin; row < some.rows.end; ++row)
      {
        add(row, messages[std::size_t(some.rank)]);
      }
    }
    return messages;
  };
  const std::vector<Segments> sent = messagesOf(passing.sent);
  const std::vector<Segments> received = messagesOf(passing.received);
  ExchangeBuffers room;
  ExchangePacked(
    *this->All, BytesOf(sent), BytesOf(received), room,
    [&sent](std::size_t rank, std::byte* next)
    {
      for (const Segment& segment : sent[rank])
      {
        next = std::copy_n(segment.first, segment.bytes, next);
      }
    },
    [&received](std::size_t rank, const std::byte* next)
    {
      for (const Segment& segment : received[rank])
      {
        std::copy_n(next, segment.bytes, segment.first);
        next += segment.bytes;
      }
    });
}

void BandDecomposition::PassRays(int from, int to, const std::vector<RayValues>& carried) const
{
  if (from / this->SlicesPerStretch == to / this->SlicesPerStretch)
  {
    return;
  }
  const OnSlice passing = this->Pass([this, from](int rank) { return this->RaysOf(rank, from); },
    [this, to](int rank) { return this->RaysOf(rank, to); });
  this->Exchange(passing,
    [&](int row, std::vector<Segment>& segments)
    {
      // All other rays still have their initial values, on all ranks.
      const Range<int>& columns = this->Visited[std::size_t(row)];
      for (const RayValues& values : carried)
      {
        AddSegment(values, this->Frustum.RayAt(0, row), columns, segments);
      }
    });
}

void BandDecomposition::ExchangeRays(int s, bool cubic, const std::vector<float*>& images) const
{
  this->Exchange(this->Rays[cubic ? 1 : 0][std::size_t(s)],
    [&](int row, std::vector<Segment>& segments)
    {
      // Other rays have the values of the previous slice. An effect belongs to both layers next to
      // the slice and ends with the next slice.
      Range<int> columns = this->Frustum.ColumnsOf(row);
      if (!cubic)
      {
        columns = Hull(this->Frustum.ActiveRays(std::max(s - 1, 0), row),
          Hull(this->Frustum.ActiveRays(s, row),
            this->Frustum.ActiveRays(std::min(s + 1, this->Frustum.lastSlice), row)));
      }
      for (float* image : images)
      {
        AddSegment(image, this->Frustum.RayAt(0, row), columns, segments);
      }
    });
}

void BandDecomposition::ExchangeVoxels(int s, const std::vector<SliceWindow*>& fields) const
{
  if (fields.empty())
  {
    return;
  }
  this->Exchange(this->Voxels[std::size_t(s)],
    [&](int v, std::vector<Segment>& segments)
    {
      const Range<int> columns = this->Frustum.FilledVoxels(s, v);
      for (SliceWindow* field : fields)
      {
        AddSegment(field->Row(this->Frustum.SliceAt(s).node, v), 0, columns, segments);
      }
    });
}

NodeBox BoxOf(const FaceFrustum& frustum, const Range<int>& columns, const Range<int>& rows,
  const Range<int>& nodes)
{
  NodeBox box;
  box.along[std::size_t(frustum.axisU)] = columns;
  box.along[std::size_t(frustum.axisV)] = rows;
  box.along[std::size_t(frustum.axisW)] = nodes;
  return box;
}

Region OwnedRegion(const FaceFrustum& frustum, const BandDecomposition& bands, int rank)
{
  Region region;
  for (int s = frustum.firstNodeSlice; s <= frustum.lastSlice; ++s)
  {
    const Slice& slice = frustum.SliceAt(s);
    Add(BoxOf(frustum, slice.ownedColumns, bands.VoxelsOf(rank, s), { slice.node, slice.node + 1 }),
      frustum.axisW, region);
  }
  return region;
}

Region NeededRegion(
  const FaceFrustum& frustum, const BandDecomposition& bands, int rank, int margin)
{
  // Find the voxels that any ray reads; a layer is read together with the slice in front of it.
  std::vector<Range<int>> columns(std::size_t(bands.Depth()));
  std::vector<Range<int>> rows(columns.size());
  for (int s = 0; s < frustum.SliceCount(); ++s)
  {
    const Slice& slice = frustum.SliceAt(s);
    for (const int node : { slice.node, slice.nodes[0], slice.nodes[1] })
    {
      if (node >= 0)
      {
        const auto at = std::size_t(node);
        columns[at] = Hull(columns[at], slice.touchedColumns);
        rows[at] = Hull(rows[at], slice.touchedRows);
      }
    }
  }
  Region region;
  for (int node = 0; node < bands.Depth(); ++node)
  {
    const auto at = std::size_t(node);
    const Range<int> needed = Intersection(rows[at], bands.VoxelsNeeded(rank, node));
    Add(BoxOf(frustum, Grown(columns[at], margin, frustum.nodesU),
          Grown(needed, margin, frustum.nodesV), { node, node + 1 }),
      frustum.axisW, region);
  }
  return region;
}
}
