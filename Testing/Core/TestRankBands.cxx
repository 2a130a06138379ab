// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How ranks divide a sweep: every row of rays and every voxel is one rank's, the work is even, and
// what a rank needs of the fields is little more than its share.

#include "BoxScene.h"
#include "PlanSweep.h"
#include "SilentRanks.h"

#include "optimize/PreparedScene.h"
#include "scene/FieldView.h"
#include "sweep/BandDecomposition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <vector>

using namespace limpid;

namespace
{
/// Values of a region that may differ from 0.
Index FilledIn(const Region& region, const Occupancy& occupancy)
{
  Index count = 0;
  for (const NodeBox& box : region)
  {
    ForRowsOf(box, &occupancy, [&count](const Int3&, int length) { count += length; });
  }
  return count;
}

/// What FindEvenBands makes least for a border between bands, times their number. `placeOn`: of a
/// stretch.
template <class PlaceOn>
Index CostOfBorder(const FaceFrustum& frustum, int border, int bands, const PlaceOn& placeOn)
{
  Index cost = 0;
  int last = 0;
  for (int first = 0; first < frustum.SliceCount(); first += slicesPerStretch)
  {
    const int place = placeOn(first);
    Index before = 0;
    Index all = 0;
    for (int s = first; s < std::min(first + slicesPerStretch, frustum.SliceCount()); ++s)
    {
      const std::vector<Index> work = WorkOfRows(frustum, s);
      before += std::accumulate(work.begin(), work.begin() + place, Index(0));
      all += std::accumulate(work.begin(), work.end(), Index(0));
    }
    const int passed = first > 0 ? std::abs(place - last) : 0;
    cost += std::abs(bands * before - border * all) +
      bands * timeOfPassing * Index(frustum.columns) * passed;
    last = place;
  }
  return cost;
}

class BandsOfRanks : public ::testing::TestWithParam<int>
{
protected:
  BandsOfRanks()
    : Scene(BoxScene::Cube(64))
    , Ranks(GetParam())
  {
    this->Scene.FillOnion();
  }

  /// Calls what(frustum, bands) for what a camera and the light see.
  template <class What>
  void ForFrusta(const What& what)
  {
    PreparedScene prepared(this->Scene.Fields());
    const Problem problem =
      prepared.ProblemFor(this->Scene.camera, this->Scene.light, this->Scene.settings);
    for (const RaySource& source : { problem.Camera(), problem.Light() })
    {
      for (const PlannedFrustum& frustum :
        PlanSweep(problem.grid, *problem.occupancy, source, PlanSettings{}))
      {
        what(frustum, BandDecomposition(frustum, this->Ranks), *problem.occupancy);
      }
    }
  }

  Index Nodes() const { return this->Scene.grid.NodeCount(); }

  /// Marks the nodes of a box that may differ from 0.
  void Mark(const NodeBox& box, const Occupancy& occupancy, std::vector<char>& nodes) const
  {
    const Int3 size = this->Scene.grid.nodes;
    ForRowsOf(box, &occupancy,
      [&](const Int3& first, int count)
      {
        std::fill_n(
          nodes.begin() + (Index(first.z) * size.y + first.y) * size.x + first.x, count, char(1));
      });
  }

  BoxScene Scene;
  SilentRanks Ranks;
};
}

TEST_P(BandsOfRanks, HaveEveryRowAndEveryVoxelOnce)
{
  this->ForFrusta(
    [this](const FaceFrustum& frustum, const BandDecomposition& bands, const Occupancy&)
    {
      for (int s = 0; s <= frustum.lastSlice; ++s)
      {
        std::vector<int> rays(std::size_t(frustum.rows), 0);
        std::vector<int> voxels(std::size_t(frustum.nodesV), 0);
        const auto count = [](const Range<int>& rows, std::vector<int>& owners)
        {
          for (int row = rows.begin; row < rows.end; ++row)
          {
            ++owners[std::size_t(row)];
          }
        };
        for (int rank = 0; rank < this->Ranks.Size(); ++rank)
        {
          count(bands.RaysOf(rank, s), rays);
          count(s < frustum.firstNodeSlice ? Range<int>{} : bands.VoxelsOf(rank, s), voxels);
        }
        EXPECT_EQ(rays, std::vector<int>(rays.size(), 1));
        for (int v = 0; v < frustum.nodesV; ++v)
        {
          EXPECT_EQ(voxels[std::size_t(v)], frustum.SliceAt(s).ownedRows.Contains(v) ? 1 : 0);
        }
      }
    });
}

TEST_P(BandsOfRanks, AreEvenAtTheLeastCost)
{
  this->ForFrusta(
    [this](const FaceFrustum& frustum, const BandDecomposition& bands, const Occupancy&)
    {
      const int ranks = this->Ranks.Size();
      for (int border = 1; border < ranks; ++border)
      {
        const auto found = [&](int s) { return bands.RaysOf(border, s).begin; };
        const Index least = CostOfBorder(frustum, border, ranks, found);
        for (int place = 0; place <= frustum.rows; ++place)
        {
          const auto stays = [&](int) { return place; };
          EXPECT_LE(least, CostOfBorder(frustum, border, ranks, stays));
          for (const int step : { -1, 1 })
          {
            // From somewhere on a row beside what was found.
            const auto beside = [&](int s)
            {
              const bool moved = s >= place * slicesPerStretch;
              return std::clamp(found(s) + (moved ? step : 0), 0, frustum.rows);
            };
            EXPECT_LE(least, CostOfBorder(frustum, border, ranks, beside));
          }
        }
      }
    });
}

TEST_P(BandsOfRanks, NeedLittleMoreThanTheirShareOfTheFields)
{
  this->ForFrusta(
    [this](const FaceFrustum& frustum, const BandDecomposition& bands, const Occupancy& occupancy)
    {
      Index most = 0;
      Index changed = 0;
      for (int rank = 0; rank < this->Ranks.Size(); ++rank)
      {
        most = std::max(most, FilledIn(NeededRegion(frustum, bands, rank), occupancy));
        changed += FilledIn(OwnedRegion(frustum, bands, rank), occupancy);
      }
      // On every slice, rays and voxels of neighbours read up to two rows on either side of a band,
      // and filled voxels need not be distributed like the rays that matter.
      const Index rows = Index(frustum.nodesU) * frustum.SliceCount() * 4;
      EXPECT_LE(most, changed * 13 / 10 / this->Ranks.Size() + rows);
    });
}

TEST_P(BandsOfRanks, NeedTogetherNoMoreThanIfTheyWereDividedAtRandom)
{
  const int ranks = this->Ranks.Size();
  std::vector<std::vector<char>> needed; // [rank][node]
  Index filled = 0;
  Index halos = 0;
  int frusta = 0;
  this->ForFrusta(
    [&](const FaceFrustum& frustum, const BandDecomposition& bands, const Occupancy& occupancy)
    {
      needed.resize(std::size_t(ranks), std::vector<char>(std::size_t(this->Nodes()), 0));
      for (int rank = 0; rank < ranks; ++rank)
      {
        for (const NodeBox& box : NeededRegion(frustum, bands, rank))
        {
          this->Mark(box, occupancy, needed[std::size_t(rank)]);
        }
      }
      filled = occupancy.FilledVoxels();
      halos += Index(frustum.nodesU) * frustum.SliceCount() * 4; // see above
      ++frusta;
    });
  Index most = 0;
  for (const std::vector<char>& ofRank : needed)
  {
    most = std::max(most, std::accumulate(ofRank.begin(), ofRank.end(), Index(0)));
  }
  // The probability that a node is in no band of a rank, for this number of frusta.
  const double none = std::pow(1 - 1.0 / ranks, frusta);
  EXPECT_LE(double(most), double(filled) * (1 - none) + double(halos));
  const auto bytes = [](double nodes) { return nodes * sizeof(float); };
  std::printf("%d ranks: %.0f bytes of a field, a share has %.0f\n", ranks, bytes(double(most)),
    bytes(double(filled) / ranks));
}

INSTANTIATE_TEST_SUITE_P(Ranks, BandsOfRanks, ::testing::Values(1, 2, 4, 8));
