// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How ranks divide a sweep: every row of rays and every voxel is one rank's, the work is even, and
// what a rank needs of the fields is little more than its share.

#include "BoxScene.h"
#include "SilentRanks.h"

#include "optimize/PreparedScene.h"
#include "sweep/PlanSweep.h"
#include "sweep/RankBands.h"
#include "sweep/RankRegions.h"

#include <gtest/gtest.h>

#include <algorithm>
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
    for (int k = box.along[2].begin; k < box.along[2].end; ++k)
    {
      for (int j = box.along[1].begin; j < box.along[1].end; ++j)
      {
        count += std::max(Intersection(box.along[0], occupancy.Row(0, j, k).filled).Length(), 0);
      }
    }
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
    for (const RaySource& source : { problem.camera, problem.light })
    {
      for (const PlannedFrustum& frustum :
        PlanSweep(problem.grid, *problem.occupancy, source, PlanSettings{}))
      {
        what(frustum, RankBands(frustum, this->Ranks), *problem.occupancy);
      }
    }
  }

  BoxScene Scene;
  SilentRanks Ranks;
};
}

TEST_P(BandsOfRanks, HaveEveryRowAndEveryVoxelOnce)
{
  this->ForFrusta(
    [this](const FaceFrustum& frustum, const RankBands& bands, const Occupancy&)
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
    [this](const FaceFrustum& frustum, const RankBands& bands, const Occupancy&)
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
    [this](const FaceFrustum& frustum, const RankBands& bands, const Occupancy& occupancy)
    {
      Index most = 0;
      Index changed = 0;
      for (int rank = 0; rank < this->Ranks.Size(); ++rank)
      {
        most = std::max(most, FilledIn(RegionNeeded(frustum, bands, rank), occupancy));
        changed += FilledIn(RegionChanged(frustum, bands, rank), occupancy);
      }
      // Of every slice, rays and voxels of neighbours read up to two rows on either side of a band,
      // rays the layer behind, too, and what is filled need not lie as the rays that matter do.
      const Index rows = Index(frustum.nodesU) * frustum.SliceCount() * 6;
      EXPECT_LE(most, changed * 13 / 10 / this->Ranks.Size() + rows);
    });
}

INSTANTIATE_TEST_SUITE_P(Ranks, BandsOfRanks, ::testing::Values(1, 2, 4, 8));
