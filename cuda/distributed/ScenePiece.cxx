// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "distributed/ScenePiece.h"

#include "distributed/EvenSlabs.h"

#include <algorithm>
#include <string>
#include <utility>

namespace limpid
{
namespace
{
constexpr std::size_t endsOfBox = 6;

/// Gathers the boxes of all ranks.
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

/// Returns the axis along which two overlapping boxes begin one after the other, and the number of
/// layers of their overlap; the axis with the fewest layers; -1 if there is none.
int AxisOfOverlap(const NodeBox& one, const NodeBox& other)
{
  int found = -1;
  int fewest = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Range<int>& a = one.along[std::size_t(axis)];
    const Range<int>& b = other.along[std::size_t(axis)];
    const bool behind =
      (a.begin < b.begin && a.end < b.end) || (b.begin < a.begin && b.end < a.end);
    const int layers = Intersection(a, b).Length();
    if (behind && (found < 0 || layers < fewest))
    {
      found = axis;
      fewest = layers;
    }
  }
  return found;
}

bool Contains(const NodeBox& box, const NodeBox& other)
{
  return other.Empty() || Intersection(box, other).Count() == other.Count();
}

/// Removes from `one` and `other`, which are parts of the boxes `a` and `b`, what the other rank
/// owns.
void Part(const NodeBox& a, const NodeBox& b, NodeBox& one, NodeBox& other)
{
  if (Intersection(a, b).Empty())
  {
    return;
  }
  if (Contains(a, b) || Contains(b, a))
  {
    (Contains(a, b) ? other : one) = {};
    return;
  }
  const int axis = AxisOfOverlap(a, b);
  if (axis >= 0)
  {
    const auto along = std::size_t(axis);
    const bool inOrder = a.along[along].begin < b.along[along].begin;
    const Range<int>& front = (inOrder ? a : b).along[along];
    const Range<int>& back = (inOrder ? b : a).along[along];
    const int middle = (back.begin + front.end) / 2;
    Range<int>& first = (inOrder ? one : other).along[along];
    Range<int>& second = (inOrder ? other : one).along[along];
    first.end = std::min(first.end, middle);
    second.begin = std::max(second.begin, middle);
  }
}

/// Returns disjoint parts of the boxes that cover their union.
std::vector<NodeBox> Parted(const std::vector<NodeBox>& boxes)
{
  std::vector<NodeBox> parts = boxes;
  for (std::size_t rank = 0; rank < boxes.size(); ++rank)
  {
    for (std::size_t other = 0; other < rank; ++other)
    {
      Part(boxes[other], boxes[rank], parts[other], parts[rank]);
    }
  }
  for (std::size_t rank = 0; rank < boxes.size(); ++rank)
  {
    Index counted = 0;
    bool apart = true;
    for (std::size_t other = 0; other < boxes.size(); ++other)
    {
      counted += Intersection(boxes[rank], parts[other]).Count();
      apart = apart && (other == rank || Intersection(parts[rank], parts[other]).Empty());
    }
    if (!apart || counted != boxes[rank].Count())
    {
      throw JointError("The piece of rank " + std::to_string(rank) +
        " overlaps others in a corner (the nodes that each rank owns would not form a box). Give "
        "ranks pieces that overlap by layers, or not at all.");
    }
  }
  return parts;
}

/// Returns the first node of another axis over the same length that is not before a node of this
/// one, which has `from` nodes; the end for the end.
int FirstFrom(int node, int from, int to)
{
  if (node >= from || from < 2)
  {
    return node >= from ? to : 0;
  }
  const Index cells = from - 1;
  return static_cast<int>((Index(node) * (to - 1) + cells - 1) / cells);
}
}

std::shared_ptr<const ScenePiece> ScenePiece::Whole(const Grid& grid)
{
  return std::make_shared<const ScenePiece>(Slabs(ThisProcess(), grid));
}

ScenePiece ScenePiece::Slabs(std::shared_ptr<const Communicator> among, const Grid& grid)
{
  ScenePiece piece;
  piece.boxes = piece.owned = EvenSlabs(*among, grid.nodes);
  piece.nodes = piece.boxes[std::size_t(among->Rank())];
  piece.all = NodeBox::Of(grid.nodes);
  piece.ranks = std::move(among);
  return piece;
}

ScenePiece::ScenePiece(
  std::shared_ptr<const Communicator> among, const Grid& grid, const NodeBox& own)
  : ranks(std::move(among))
  , nodes(own)
  , boxes(BoxesOf(*this->ranks, own))
  , owned(Parted(this->boxes))
  , all(NodeBox::Of(grid.nodes))
{
  for (std::size_t rank = 0; rank < this->boxes.size(); ++rank)
  {
    if (!Contains(this->all, this->boxes[rank]))
    {
      throw JointError("The piece of rank " + std::to_string(rank) +
        " extends outside the image (its fields would not fit the grid). Give every rank a part of "
        "the same image.");
    }
  }
}

std::shared_ptr<const ScenePiece> Grown(const ScenePiece& piece, const Grid& grid, int nodes)
{
  auto grown = std::make_shared<ScenePiece>(piece);
  const NodeBox few = Intersection(NodeBox::Of(Int3(2)), NodeBox::Of(grid.nodes));
  for (std::size_t rank = 0; rank < grown->boxes.size(); ++rank)
  {
    const NodeBox& own = piece.owned[rank];
    grown->boxes[rank] = own.Empty() ? few : own.Grown(nodes, grid.nodes);
  }
  grown->nodes = grown->boxes[std::size_t(piece.ranks->Rank())];
  return grown;
}

std::shared_ptr<const ScenePiece> PieceOn(const ScenePiece& piece, const Grid& from, const Grid& to)
{
  NodeBox own = piece.Owned();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    Range<int>& along = own.along[axis];
    const int nodes = from.nodes[int(axis)];
    along = { FirstFrom(along.begin, nodes, to.nodes[int(axis)]),
      FirstFrom(along.end, nodes, to.nodes[int(axis)]) };
  }
  return std::make_shared<const ScenePiece>(piece.ranks, to, own);
}

Grid GridOf(const NodeBox& box, const Grid& whole)
{
  Grid grid = whole;
  grid.nodes = box.Size();
  grid.origin =
    whole.PointToWorld(Vec3(box.along[0].begin, box.along[1].begin, box.along[2].begin));
  return grid;
}

Grid GridOf(const ScenePiece& piece, const Grid& whole)
{
  return GridOf(piece.nodes, whole);
}

bool HaveSameBoxes(const ScenePiece* one, const ScenePiece* other)
{
  return one && other ? one->boxes == other->boxes : one == other;
}
}
