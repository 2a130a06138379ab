// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/RankRegions.h"

#include "sweep/RankBands.h"

#include <algorithm>
#include <utility>

namespace limpid
{
namespace
{
/// Adds a box, or makes the last one longer along an axis where it goes on there.
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

/// Calls what(box) for all boxes of nodes that are in both regions, in a fixed order.
template <class What>
void ForBoth(const Region& one, const Region& other, const What& what)
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

/// Values one after the other, and where they are in a field.
struct RowInField
{
  float* first;
  Index stride;

  RowInField(const FieldView& field, const Int3& node)
    : first(field.values + field.At(node.x, node.y, node.z))
    , stride(field.stride[0])
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

Region RegionChanged(const FaceFrustum& frustum, const RankBands& bands, int rank)
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

Region RegionNeeded(const FaceFrustum& frustum, const RankBands& bands, int rank)
{
  Region region;
  for (int node = 0; node < bands.Depth(); ++node)
  {
    Add(SliceOf(frustum, node, { 0, frustum.nodesU }, bands.VoxelsNeeded(rank, node)),
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
  const NodeBox& box, const FieldView& from, const FieldView& to, const Occupancy* filled)
{
  ForRowsOf(box, filled,
    [&](const Int3& first, int count)
    {
      const RowInField there(to, first);
      const RowInField here(from, first);
      if (there.stride == 1)
      {
        here.CopyTo(there.first, count);
        return;
      }
      for (int i = 0; i < count; ++i)
      {
        there.first[i * there.stride] = here.first[i * here.stride];
      }
    });
}

Passages::WithRank Passages::Between(
  const Region& had, const Region& needed, const Occupancy* filled)
{
  WithRank passing;
  ForBoth(had, needed,
    [&](const NodeBox& box)
    {
      ForRowsOf(box, filled,
        [&passing](const Int3& first, int count)
        {
          passing.rows.push_back({ first, count });
          passing.count += std::size_t(count);
        });
    });
  return passing;
}

Passages::Passages(const Communicator& ranks, const std::vector<Region>& had,
  const std::vector<Region>& needed, const Occupancy* filled)
  : All(&ranks)
{
  const auto own = std::size_t(ranks.Rank());
  for (std::size_t rank = 0; rank < had.size(); ++rank)
  {
    const bool isOther = rank != own;
    this->Sent.push_back(isOther ? Between(had[own], needed[rank], filled) : WithRank());
    this->Received.push_back(isOther ? Between(had[rank], needed[own], filled) : WithRank());
  }
  ForBoth(had[own], needed[own], [this](const NodeBox& box) { this->Own.push_back(box); });
}

void Passages::Bring(const FieldView& from, const FieldView& to) const
{
  std::vector<Communicator::Message> sent;
  std::vector<Communicator::Message> received;
  const auto add =
    [](std::vector<Communicator::Message>& messages, std::size_t rank, const WithRank& passing)
  {
    passing.values.resize(passing.count);
    if (passing.count > 0)
    {
      messages.push_back(
        { static_cast<int>(rank), passing.values.data(), passing.count * sizeof(float) });
    }
  };
  for (std::size_t rank = 0; rank < this->Sent.size(); ++rank)
  {
    add(sent, rank, this->Sent[rank]);
    add(received, rank, this->Received[rank]);
    float* next = this->Sent[rank].values.data();
    for (const Row& row : this->Sent[rank].rows)
    {
      RowInField(from, row.first).CopyTo(next, row.count);
      next += row.count;
    }
  }
  this->All->Exchange(sent, received);
  for (const WithRank& passing : this->Received)
  {
    const float* next = passing.values.data();
    for (const Row& row : passing.rows)
    {
      RowInField(to, row.first).CopyFrom(next, row.count);
      next += row.count;
    }
  }
  if (from.values != to.values)
  {
    for (const NodeBox& box : this->Own)
    {
      CopyNodes(box, from, to);
    }
  }
}
}
