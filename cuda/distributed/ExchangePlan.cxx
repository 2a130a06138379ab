// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "distributed/ExchangePlan.h"

#include <algorithm>
#include <utility>

namespace limpid
{
namespace
{
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

void ExchangePlan::Bring(const std::vector<Field>& fields) const
{
  const auto bytesOf = [&fields](const std::vector<WithRank>& passing)
  {
    std::vector<std::size_t> bytes;
    bytes.reserve(passing.size());
    for (const WithRank& some : passing)
    {
      bytes.push_back(fields.size() * some.count * sizeof(float));
    }
    return bytes;
  };
  ExchangePacked(
    *this->All, bytesOf(this->Sent), bytesOf(this->Received), *this->Room,
    [&](std::size_t rank, std::byte* buffer)
    {
      auto* next = reinterpret_cast<float*>(buffer);
      this->ForRows(this->Sent[rank],
        [&](const Int3& first, int count)
        {
          for (const Field& field : fields)
          {
            RowInField(field.from, first, this->Axis).CopyTo(next, count);
            next += count;
          }
        });
    },
    [&](std::size_t rank, const std::byte* buffer)
    {
      const auto* next = reinterpret_cast<const float*>(buffer);
      this->ForRows(this->Received[rank],
        [&](const Int3& first, int count)
        {
          for (const Field& field : fields)
          {
            RowInField(field.to, first, this->Axis).CopyFrom(next, count);
            next += count;
          }
        });
    });
  for (const Field& field : fields)
  {
    if (!field.from.IsSameAs(field.to))
    {
      for (const NodeBox& box : this->Own)
      {
        CopyNodes(box, field.from, field.to, this->Filled, this->Axis);
      }
    }
  }
}
}
