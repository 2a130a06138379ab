// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "scene/ScenePiece.h"

#include "math/Require.h"

#include <utility>

namespace limpid
{
namespace
{
constexpr std::size_t endsOfBox = 6;

/// The boxes of all ranks.
std::vector<NodeBox> BoxesOf(const Communicator& ranks, const NodeBox& own)
{
  const auto count = static_cast<std::size_t>(ranks.Size());
  std::vector<std::int64_t> ends(endsOfBox * count, 0);
  std::int64_t* next = ends.data() + endsOfBox * std::size_t(ranks.Rank());
  for (const Range<int>& along : own.along)
  {
    *next++ = along.begin;
    *next++ = along.end;
  }
  ranks.Sum(ends.data(), ends.size());
  std::vector<NodeBox> boxes(count);
  const std::int64_t* end = ends.data();
  for (NodeBox& box : boxes)
  {
    for (Range<int>& along : box.along)
    {
      along.begin = static_cast<int>(*end++);
      along.end = static_cast<int>(*end++);
    }
  }
  return boxes;
}
}

ScenePiece::ScenePiece(
  std::shared_ptr<const Communicator> all, const Grid& grid, const NodeBox& own)
  : ranks(std::move(all))
  , nodes(own)
  , ofRanks(BoxesOf(*this->ranks, own))
{
  const NodeBox whole = NodeBox::Of(grid.nodes);
  for (std::size_t rank = 0; rank < this->ofRanks.size(); ++rank)
  {
    const NodeBox& box = this->ofRanks[rank];
    LIMPID_REQUIRE(box.Empty() || Intersection(box, whole).Count() == box.Count(),
      "The piece of rank " << rank << " is not within the image (it has nodes that are none). Give "
                              "every rank a part of the same image.");
    for (std::size_t other = 0; other < rank; ++other)
    {
      LIMPID_REQUIRE(Intersection(box, this->ofRanks[other]).Empty(),
        "The pieces of the ranks " << other << " and " << rank
                                   << " overlap (a node belongs to one of them). Leave out what is "
                                      "there for neighbours only.");
    }
  }
}
}
