// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "energy/TransmittanceOnRanks.h"

#include "backend/Interruption.h"
#include "backend/LargePages.h"
#include "distributed/ExchangePlan.h"
#include "distributed/Neighbourhood.h"
#include "distributed/OccupancyOnRanks.h"
#include "energy/NodeTransmittance.h"
#include "energy/TransmittanceSweep.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

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

/// The cells of a rank: those whose first owned corner belongs to it.
struct CellsOfRank
{
  std::vector<NodesWithin> owned; ///< [rank]: owned nodes
  NodesWithin own;
  Int3 last; ///< last node of the grid
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

  /// Returns the range of the first nodes of all cells that may belong to this rank.
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

/// A field of a subdomain, extended by ghost values from the owners.
struct WiderField
{
  FieldInBox values;
  FieldWithin nodes;

  WiderField(const ScenePiece& piece, const ScenePiece& wider, const float* field)
    : values(FieldIn(piece, wider.boxes, There(field)))
    , nodes{ this->values.Data(), Within(wider.nodes) }
  {
  }
};

/// Returns the nodes of a rank around which transmittance is steep.
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

/// Nodes of all ranks, gathered on every rank.
struct NodesOfRanks
{
  std::vector<std::int64_t> coordinates; ///< three per node
  std::size_t first = 0;                 ///< index of this rank's first node

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

void SweepSubdomains(
  std::vector<FrustumRays<HostDevice>>& frusta, const ScenePiece& piece, const Occupancy* filled)
{
  const FieldLayout home(*piece.ranks, piece.nodes, RegionsOf(piece.owned), RegionsOf(piece.boxes));
  for (FrustumRays<HostDevice>& rays : frusta)
  {
    rays.SweepFieldsOf(home, filled);
  }
}

void FindTransmittanceOnRanks(const Grid& grid, const ScenePiece& piece, const RaySource& source,
  double rayDensity, const float* extinction, float* transmittance)
{
  if (piece.IsWhole())
  {
    FillTransmittance(grid, extinction, source, rayDensity, transmittance);
    return;
  }
  const SmallPages small;
  const FieldView given = FieldView::Part(const_cast<float*>(extinction), piece.nodes);
  const Occupancy occupancy =
    OccupancyOnRanks(*piece.ranks, grid, piece.Owned(), given, given, /*skip=*/true);
  TransmittanceSweep<HostDevice> sweep(HostDevice::Shared(), grid, occupancy, source, rayDensity);
  SweepSubdomains(sweep.Frusta(), piece, nullptr);
  std::fill(transmittance, transmittance + piece.nodes.Count(), 1.0f); // for nodes that no ray
                                                                       // reaches
  sweep.Sweep(There(extinction), There(transmittance));
}

void RefineTransmittanceOnRanks(const Grid& grid, const ScenePiece& piece, const RaySource& source,
  const float* extinction, float* transmittance)
{
  constexpr std::size_t nodesAtATime = 1 << 18; // per rank
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
    std::vector<std::int64_t> depths(nodes.Count()); // sums of many ranks
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
