// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "energy/NodeTransmittance.h"

#include "backend/Backend.h"
#include "backend/Interruption.h"
#include "math/Require.h"
#include "scene/NodeValues.h"
#include "scene/ScenePiece.h"
#include "sweep/RankRegions.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <vector>

namespace limpid
{
namespace
{
NodesWithin Within(const NodeBox& box)
{
  const auto& along = box.along;
  return box.Empty() ? NodesWithin{ Int3(0), Int3(0) }
                     : NodesWithin{ { along[0].begin, along[1].begin, along[2].begin },
                         { along[0].end, along[1].end, along[2].end } };
}

/// A rank's part of the cells: those whose first corner with an owner is its own.
struct CellsOfRank
{
  std::vector<NodesWithin> owned; ///< [rank]
  NodesWithin own;
  Int3 last; ///< node of the grid
  std::size_t rank;

  CellsOfRank(const ScenePiece& piece, const Grid& grid)
    : last(grid.nodes - 1)
    , rank(std::size_t(piece.ranks->Rank()))
  {
    for (const NodeBox& box : piece.owned)
    {
      this->owned.push_back(Within(box));
    }
    this->own = this->owned[this->rank];
  }

  /// The first nodes of all that may be.
  NodesWithin Near() const
  {
    return { glm::max(this->own.begin - 1, Int3(0)), glm::min(this->own.end, this->last) };
  }

  bool operator()(const Int3& cell) const
  {
    for (int corner = 0; corner < 8; ++corner)
    {
      const Int3 node = cell + Int3(corner & 1, corner >> 1 & 1, corner >> 2);
      if (this->own.Contains(node))
      {
        return true;
      }
      if (std::any_of(this->owned.begin(), this->owned.end(),
            [&](const NodesWithin& box) { return box.Contains(node); }))
      {
        return false;
      }
    }
    return false;
  }
};

/// A field of a piece, of which owners tell others what is beside them.
struct WiderField
{
  NodeValues values;
  FieldWithin nodes;

  WiderField(const ScenePiece& piece, const ScenePiece& wider, const float* field)
    : values(wider.nodes.Count())
    , nodes{ this->values.Data(), Within(wider.nodes) }
  {
    Spread(*piece.ranks, FieldView::Part(const_cast<float*>(There(field)), piece.nodes),
      RegionsOf(piece.owned), FieldView::Part(this->values.Data(), wider.nodes),
      RegionsOf(wider.boxes));
  }
};

/// The nodes of a rank to which transmittance is steep.
std::vector<Int3> SteepNodes(
  const NodesWithin& own, const FieldWithin& transmittance, const NodeRays& rays)
{
  std::vector<Int3> steep;
  for (int k = own.begin.z; k < own.end.z; ++k)
  {
    Interruptible::Check();
    for (int j = own.begin.y; j < own.end.y; ++j)
    {
      for (int i = own.begin.x; i < own.end.x; ++i)
      {
        const Int3 node(i, j, k);
        if (transmittance.IsSteepAt(node) && rays.See(node))
        {
          steep.push_back(node);
        }
      }
    }
  }
  return steep;
}

/// Some nodes of each rank, which all ranks learn.
struct NodesOfRanks
{
  std::vector<std::int64_t> coordinates; ///< three a node
  std::size_t first = 0;                 ///< of this rank's

  NodesOfRanks(const Communicator& ranks, const Int3* nodes, std::size_t count)
  {
    std::vector<std::int64_t> counts(std::size_t(ranks.Size()));
    const auto own = counts.begin() + ranks.Rank();
    *own = static_cast<std::int64_t>(count);
    ranks.Sum(counts.data(), counts.size());
    this->first = std::size_t(std::accumulate(counts.begin(), own, std::int64_t(0)));
    this->coordinates.resize(
      3 * std::size_t(std::accumulate(counts.begin(), counts.end(), std::int64_t(0))));
    for (std::size_t i = 0; i < 3 * count; ++i)
    {
      this->coordinates[3 * this->first + i] = nodes[i / 3][int(i % 3)];
    }
    ranks.Sum(this->coordinates.data(), this->coordinates.size());
  }

  std::size_t Count() const { return this->coordinates.size() / 3; }
  Int3 operator[](std::size_t i) const
  {
    const std::int64_t* node = this->coordinates.data() + 3 * i;
    return { int(node[0]), int(node[1]), int(node[2]) };
  }
};
}

NodeRays::NodeRays(const Grid& grid, const RaySource& source)
  : Parallel(source.parallel)
  , Origin(source.parallel ? source.direction : source.origin)
  , Spacing(grid.spacing)
  , LastCell(grid.nodes - 2)
  , PlaneCount(static_cast<int>(source.viewPlanes.size()))
{
  LIMPID_REQUIRE(source.viewPlanes.size() <= std::size(this->Planes),
    "A picture has " << source.viewPlanes.size() << " sides (rays know " << std::size(this->Planes)
                     << "). Give it four corners.");
  std::copy(source.viewPlanes.begin(), source.viewPlanes.end(), this->Planes);
}

void RefineTransmittanceOnRanks(const Grid& grid, const ScenePiece& piece, const RaySource& source,
  const float* extinction, float* transmittance)
{
  constexpr std::size_t nodesAtATime = 1 << 18; // of a rank
  const Communicator& ranks = *piece.ranks;
  const NodeRays rays(grid, source);
  const CellsOfRank cells(piece, grid);
  const auto wider = Grown(piece, grid, 1);
  const WiderField absorbing(piece, *wider, extinction);
  const std::vector<Int3> steep =
    SteepNodes(cells.own, WiderField(piece, *wider, transmittance).nodes, rays);
  const FieldView result = FieldView::Part(There(transmittance), piece.nodes);
  for (std::size_t done = 0; ranks.AnyOf(done < steep.size()); done += nodesAtATime)
  {
    const std::size_t begin = std::min(done, steep.size());
    const std::size_t count = std::min(steep.size() - begin, nodesAtATime);
    const NodesOfRanks nodes(ranks, steep.data() + begin, count);
    std::vector<WholeDepth> depths(nodes.Count());
    ParallelFor(Index(depths.size()), 64,
      [&](Index i)
      {
        depths[std::size_t(i)] =
          rays.DepthTo(nodes[std::size_t(i)], absorbing.nodes, cells.Near(), cells);
      });
    ranks.Sum(depths.data(), depths.size());
    for (std::size_t i = 0; i < count; ++i)
    {
      const Int3& node = steep[begin + i];
      result.values[result.At(node.x, node.y, node.z)] = TransmittanceOf(depths[nodes.first + i]);
    }
  }
  Spread(ranks, result, RegionsOf(piece.owned), result, RegionsOf(piece.boxes));
}
}
