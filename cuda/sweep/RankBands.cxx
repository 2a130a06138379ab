// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/RankBands.h"

#include "sweep/SliceWindow.h"

#include <algorithm>
#include <numeric>
#include <utility>

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

/// Bands of a rank: none of a few rows, and more where there are more ranks. Two ranks gain less by
/// even work than what passes between more bands costs.
int BandsPerRank(int rows, int ranks)
{
  constexpr int most = 4;
  constexpr int leastRows = 8;
  const int wanted = std::clamp(ranks / 2, 1, most);
  return std::clamp(rows / (leastRows * ranks), 1, wanted);
}
}

RankBands::RankBands(const FaceFrustum& frustum, const Communicator& ranks)
  : Frustum(frustum)
  , All(&ranks)
  , Begins(Divide(CostsOfRows(frustum), ranks.Size() * BandsPerRank(frustum.rows, ranks.Size())))
{
  this->FindNeeded();
  this->FindOwn();
  const auto rays = [this](int band) { return this->RaysOf(band); };
  for (int s = 0; s < frustum.SliceCount(); ++s)
  {
    const bool voxels = frustum.SliceAt(s).node >= 0;
    for (const int more : { 0, 1 })
    {
      const auto read = [&](int band) { return this->RaysReadBy(band, s, more); };
      this->Rays[more].push_back(voxels ? this->Pass(rays, read) : OnSlice());
    }
    const auto changed = [&](int band) { return this->VoxelsOf(band, s); };
    const auto needed = [&](int band) { return this->VoxelsNeeded(band, frustum.SliceAt(s).node); };
    this->Voxels.push_back(voxels ? this->Pass(changed, needed) : OnSlice());
  }
}

std::vector<int> RankBands::BandsOf(int rank) const
{
  std::vector<int> bands;
  for (int band = 0; band < this->BandCount(); ++band)
  {
    if (this->RankOf(band) == rank)
    {
      bands.push_back(band);
    }
  }
  return bands;
}

void RankBands::FindNeeded()
{
  int last = 0;
  for (int s = 0; s < this->Frustum.SliceCount(); ++s)
  {
    const Slice& slice = this->Frustum.SliceAt(s);
    last = std::max({ last, slice.node, slice.nodes[0], slice.nodes[1] });
  }
  for (int band = 0; band < this->BandCount(); ++band)
  {
    std::vector<Range<int>> rows(static_cast<std::size_t>(last) + 1);
    const auto extend = [&rows](int node, const Range<int>& by)
    { rows[std::size_t(node)] = Hull(rows[std::size_t(node)], by); };
    for (int s = 0; s < this->Frustum.SliceCount(); ++s)
    {
      const Slice& slice = this->Frustum.SliceAt(s);
      if (s < this->Frustum.lastSlice)
      {
        const Range<int> read = this->RowsRead(this->RaysOf(band), s);
        extend(slice.nodes[0], read);
        extend(slice.nodes[1], read);
      }
      if (slice.node >= 0)
      {
        extend(slice.node, this->VoxelsOf(band, s));
      }
    }
    this->Needed.push_back(std::move(rows));
  }
}

void RankBands::FindOwn()
{
  const auto add = [](const Range<int>& range, std::vector<int>& rows)
  {
    for (int row = range.begin; row < range.end; ++row)
    {
      rows.push_back(row);
    }
  };
  this->OwnVoxels.resize(std::size_t(this->Frustum.SliceCount()));
  for (const int band : this->BandsOf(this->All->Rank()))
  {
    add(this->RaysOf(band), this->OwnRays);
    for (int s = this->Frustum.firstNodeSlice; s <= this->Frustum.lastSlice; ++s)
    {
      add(this->VoxelsOf(band, s), this->OwnVoxels[std::size_t(s)]);
    }
  }
}

/// What passes between this rank and the others, of what bands have and what bands read.
template <class Had, class Read>
RankBands::OnSlice RankBands::Pass(const Had& had, const Read& read) const
{
  OnSlice passing;
  const int own = this->All->Rank();
  const auto add = [this](const Range<int>& rows, int band, std::vector<Passing>& all)
  {
    if (!rows.Empty())
    {
      all.push_back({ this->RankOf(band), rows });
    }
  };
  for (int band = 0; band < this->BandCount(); ++band)
  {
    for (int reader = 0; reader < this->BandCount(); ++reader)
    {
      const bool gives = this->RankOf(band) == own;
      const bool takes = this->RankOf(reader) == own;
      if (gives != takes)
      {
        const Range<int> rows = Intersection(had(band), read(reader));
        add(rows, gives ? reader : band, gives ? passing.sent : passing.received);
      }
    }
  }
  return passing;
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

Range<int> RankBands::VoxelsOf(int band, int s) const
{
  const Range<int> rays = this->RaysOf(band);
  const int* rows = this->Frustum.Row(this->Frustum.voxelRows, s).index;
  const int* end = rows + this->Frustum.nodesV;
  const int* first = std::lower_bound(rows, end, rays.begin);
  const int* last = std::lower_bound(first, end, rays.end);
  const Range<int> beside{ static_cast<int>(first - rows), static_cast<int>(last - rows) };
  const Range<int> owned = Intersection(beside, this->Frustum.SliceAt(s).ownedRows);
  return owned.Empty() ? Range<int>{} : owned;
}

/// Rows of rays that voxels of a band read on slice `s`, and so many more on either side.
Range<int> RankBands::RaysReadBy(int band, int s, int more) const
{
  const Range<int> voxels = this->VoxelsOf(band, s);
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

namespace
{
/// Values that follow each other in memory.
struct Segment
{
  float* first;
  std::size_t count;
};

/// What goes to a rank or comes from it, in one message.
struct Parcel
{
  int rank;
  std::vector<Segment> segments;
  std::vector<float> values;
};

Parcel& ParcelOf(int rank, std::vector<Parcel>& parcels)
{
  const auto found = std::find_if(
    parcels.begin(), parcels.end(), [rank](const Parcel& parcel) { return parcel.rank == rank; });
  if (found != parcels.end())
  {
    return *found;
  }
  parcels.push_back({ rank, {}, {} });
  return parcels.back();
}

std::vector<Communicator::Message> MessagesOf(std::vector<Parcel>& parcels)
{
  std::vector<Communicator::Message> messages;
  for (Parcel& parcel : parcels)
  {
    std::size_t count = 0;
    for (const Segment& segment : parcel.segments)
    {
      count += segment.count;
    }
    parcel.values.resize(count);
    if (count > 0)
    {
      messages.push_back({ parcel.rank, parcel.values.data(), count * sizeof(float) });
    }
  }
  return messages;
}
}

/// `add`: adds what passes of a row, to `segments`.
template <class Add>
void RankBands::Exchange(const OnSlice& passing, const Add& add) const
{
  const auto parcelsOf = [&add](const std::vector<Passing>& all)
  {
    std::vector<Parcel> parcels;
    for (const Passing& some : all)
    {
      for (int row = some.rows.begin; row < some.rows.end; ++row)
      {
        add(row, ParcelOf(some.rank, parcels).segments);
      }
    }
    return parcels;
  };
  std::vector<Parcel> sent = parcelsOf(passing.sent);
  std::vector<Parcel> received = parcelsOf(passing.received);
  const std::vector<Communicator::Message> out = MessagesOf(sent);
  const std::vector<Communicator::Message> in = MessagesOf(received);
  for (Parcel& parcel : sent)
  {
    float* next = parcel.values.data();
    for (const Segment& segment : parcel.segments)
    {
      next = std::copy_n(segment.first, segment.count, next);
    }
  }
  this->All->Exchange(out, in);
  for (const Parcel& parcel : received)
  {
    const float* next = parcel.values.data();
    for (const Segment& segment : parcel.segments)
    {
      std::copy_n(next, segment.count, segment.first);
      next += segment.count;
    }
  }
}

void RankBands::ExchangeRays(int s, bool cubic, const std::vector<float*>& images) const
{
  this->Exchange(this->Rays[cubic ? 1 : 0][std::size_t(s)],
    [&](int row, std::vector<Segment>& segments)
    {
      // Other rays are as they were on the slice before.
      const Range<int> columns =
        cubic ? Range<int>{ 0, this->Frustum.columns } : this->Frustum.ActiveRays(s, row);
      for (float* image : columns.Empty() ? std::vector<float*>() : images)
      {
        segments.push_back(
          { image + this->Frustum.RayAt(columns.begin, row), std::size_t(columns.Length()) });
      }
    });
}

void RankBands::ExchangeVoxels(int s, const std::vector<SliceWindow*>& fields) const
{
  this->Exchange(this->Voxels[std::size_t(s)],
    [&](int v, std::vector<Segment>& segments)
    {
      const Range<int>& columns = this->Frustum.FilledVoxels(s, v);
      for (SliceWindow* field : columns.Empty() ? std::vector<SliceWindow*>() : fields)
      {
        segments.push_back({ field->Row(this->Frustum.SliceAt(s).node, v) + columns.begin,
          std::size_t(columns.Length()) });
      }
    });
}
}
