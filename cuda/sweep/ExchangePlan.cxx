// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/ExchangePlan.h"

#include "sweep/BandDecomposition.h"

#include <algorithm>
#include <utility>

namespace limpid
{
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

NodeBox SliceOf(
  const FaceFrustum& frustum, int node, const Range<int>& columns, const Range<int>& rows)
{
  NodeBox box;
  box.along[std::size_t(frustum.axisU)] = columns;
  box.along[std::size_t(frustum.axisV)] = rows;
  box.along[std::size_t(frustum.axisW)] = { node, node + 1 };
  return box;
}

/// Calls what(box) for the intersections of the boxes of both regions, in a fixed order.
template <class What>
void ForIntersections(const Region& one, const Region& other, const What& what)
{
  NodeBox hull;
  for (const NodeBox& box : other)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      hull.along[axis] = Hull(hull.along[axis], box.along[axis]);
    }
  }
  for (const NodeBox& box : one)
  {
    if (Intersection(box, hull).Empty())
    {
      continue;
    }
    for (const NodeBox& second : other)
    {
      const NodeBox both = Intersection(box, second);
      if (!both.Empty())
      {
        what(both);
      }
    }
  }
}

/// Values of a row along an axis of a field.
struct RowInField
{
  float* first;
  Index stride;

  RowInField(const FieldView& field, const Int3& node, int axis = 0)
    : first(field.values + field.At(node.x, node.y, node.z))
    , stride(field.stride[std::size_t(axis)])
  {
  }

  void CopyTo(float* values, int count) const
  {
    if (this->stride == 1)
    {
      std::copy_n(this->first, count, values);
      return;
    }
    for (int i = 0; i < count; ++i)
    {
      values[i] = this->first[i * this->stride];
    }
  }

  void CopyFrom(const float* values, int count) const
  {
    if (this->stride == 1)
    {
      std::copy_n(values, count, this->first);
      return;
    }
    for (int i = 0; i < count; ++i)
    {
      this->first[i * this->stride] = values[i];
    }
  }
};
}

std::vector<Region> RegionsOf(const std::vector<NodeBox>& boxes)
{
  std::vector<Region> regions;
  regions.reserve(boxes.size());
  for (const NodeBox& box : boxes)
  {
    regions.push_back({ box });
  }
  return regions;
}

Region RegionChanged(const FaceFrustum& frustum, const BandDecomposition& bands, int rank)
{
  Region region;
  for (int s = frustum.firstNodeSlice; s <= frustum.lastSlice; ++s)
  {
    const Slice& slice = frustum.SliceAt(s);
    Add(SliceOf(frustum, slice.node, slice.ownedColumns, bands.VoxelsOf(rank, s)), frustum.axisW,
      region);
  }
  return region;
}

Region RegionNeeded(const FaceFrustum& frustum, const BandDecomposition& bands, int rank)
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
    Add(SliceOf(frustum, node, columns[at], Intersection(rows[at], bands.VoxelsNeeded(rank, node))),
      frustum.axisW, region);
  }
  return region;
}

void FillNodes(const NodeBox& box, float value, const FieldView& field)
{
  ForRowsOf(box, nullptr,
    [&](const Int3& first, int count)
    {
      const RowInField here(field, first);
      for (int i = 0; i < count; ++i)
      {
        here.first[i * here.stride] = value;
      }
    });
}

void CopyNodes(
  const NodeBox& box, const FieldView& from, const FieldView& to, const Occupancy* filled, int axis)
{
  ForRowsOf(
    box, filled,
    [&](const Int3& first, int count)
    {
      const RowInField there(to, first, axis);
      const RowInField here(from, first, axis);
      if (there.stride == 1)
      {
        here.CopyTo(there.first, count);
        return;
      }
      for (int i = 0; i < count; ++i)
      {
        there.first[i * there.stride] = here.first[i * here.stride];
      }
    },
    axis);
}

Occupancy OccupancyOnRanks(const Communicator& ranks, const Grid& grid, const NodeBox& box,
  const FieldView& extinction, const FieldView& importance, bool skip)
{
  const auto valuesOf = [&box](const FieldView& view)
  {
    std::vector<float> values(std::size_t(box.Count()));
    CopyNodes(box, view, FieldView::Part(values.data(), box));
    return values;
  };
  const std::vector<float> extinctions = valuesOf(extinction);
  const std::vector<float> importances = valuesOf(importance);
  return { ranks, grid, box, extinctions.data(), importances.data(), skip };
}

Region Intersection(const Region& region, const NodeBox& box)
{
  Region inside;
  for (const NodeBox& some : region)
  {
    const NodeBox both = Intersection(some, box);
    if (!both.Empty())
    {
      inside.push_back(both);
    }
  }
  return inside;
}

ExchangePlan::WithRank ExchangePlan::Between(const Region& had, const Region& needed) const
{
  WithRank passing;
  ForIntersections(had, needed,
    [&](const NodeBox& box)
    {
      passing.boxes.push_back(box);
      ForRowsOf(
        box, this->Filled,
        [&](const Int3& first, int count)
        {
          if (this->Kept == Keep::Rows)
          {
            passing.rows.push_back({ first, count });
          }
          passing.count += std::size_t(count);
        },
        this->Axis);
    });
  return passing;
}

ExchangePlan::ExchangePlan(const Communicator& ranks, const std::vector<Region>& had,
  const std::vector<Region>& needed, const Occupancy* filled,
  const std::shared_ptr<ExchangeBuffers>& room, Keep keep, int axis)
  : All(&ranks)
  , Filled(filled)
  , Room(room)
  , Kept(keep)
  , Axis(axis)
{
  const auto own = std::size_t(ranks.Rank());
  for (std::size_t rank = 0; rank < had.size(); ++rank)
  {
    const bool isOther = rank != own;
    this->Sent.push_back(isOther ? this->Between(had[own], needed[rank]) : WithRank());
    this->Received.push_back(isOther ? this->Between(had[rank], needed[own]) : WithRank());
  }
  ForIntersections(had[own], needed[own], [this](const NodeBox& box) { this->Own.push_back(box); });
}

/// Calls what(first node, count) for the rows of an exchange.
template <class What>
void ExchangePlan::ForRows(const WithRank& passing, const What& what) const
{
  if (this->Kept == Keep::Rows)
  {
    for (const Row& row : passing.rows)
    {
      what(row.first, row.count);
    }
    return;
  }
  for (const NodeBox& box : passing.boxes)
  {
    ForRowsOf(box, this->Filled, what, this->Axis);
  }
}

/// Returns one message for each rank with which values are exchanged, and allocates its values.
std::vector<Communicator::Message> ExchangePlan::MessagesOf(
  const std::vector<WithRank>& passing, std::size_t fields, std::vector<std::vector<float>>& values)
{
  values.resize(std::max(values.size(), passing.size()));
  std::vector<Communicator::Message> messages;
  for (std::size_t rank = 0; rank < passing.size(); ++rank)
  {
    const std::size_t count = fields * passing[rank].count;
    if (count > 0)
    {
      values[rank].resize(std::max(values[rank].size(), count));
      messages.push_back({ static_cast<int>(rank), values[rank].data(), count * sizeof(float) });
    }
  }
  return messages;
}

void ExchangePlan::Bring(const std::vector<Field>& fields) const
{
  ExchangeBuffers& room = *this->Room;
  const std::vector<Communicator::Message> sent = MessagesOf(this->Sent, fields.size(), room.sent);
  const std::vector<Communicator::Message> received =
    MessagesOf(this->Received, fields.size(), room.received);
  for (std::size_t rank = 0; rank < this->Sent.size(); ++rank)
  {
    float* next = room.sent[rank].data();
    this->ForRows(this->Sent[rank],
      [&](const Int3& first, int count)
      {
        for (const Field& field : fields)
        {
          RowInField(field.from, first, this->Axis).CopyTo(next, count);
          next += count;
        }
      });
  }
  this->All->Exchange(sent, received);
  for (std::size_t rank = 0; rank < this->Received.size(); ++rank)
  {
    const float* next = room.received[rank].data();
    this->ForRows(this->Received[rank],
      [&](const Int3& first, int count)
      {
        for (const Field& field : fields)
        {
          RowInField(field.to, first, this->Axis).CopyFrom(next, count);
          next += count;
        }
      });
  }
  for (const Field& field : fields)
  {
    if (field.from.values != field.to.values)
    {
      for (const NodeBox& box : this->Own)
      {
        CopyNodes(box, field.from, field.to, this->Filled, this->Axis);
      }
    }
  }
}
}
