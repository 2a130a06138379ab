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

/// Samples of a row of rays that matter, and voxels beside it that may change.
Index WorkOf(const FaceFrustum& frustum, int row)
{
  Index work = 1;
  for (int s = 0; s <= frustum.lastSlice; ++s)
  {
    work += s < frustum.lastSlice ? std::max(frustum.ActiveRays(s, row).Length(), 0) : 0;
    const Range<int>& owned = frustum.SliceAt(s).ownedRows;
    for (int v = owned.begin; v < owned.end && frustum.SliceAt(s).node >= 0; ++v)
    {
      const bool beside = frustum.Row(frustum.voxelRows, s).index[v] == row;
      work += beside ? std::max(frustum.FilledVoxels(s, v).Length(), 0) : 0;
    }
  }
  return work;
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
    [](const FaceFrustum& frustum, const RankBands& bands, const Occupancy&)
    {
      int row = 0;
      for (int band = 0; band < bands.BandCount(); ++band)
      {
        EXPECT_EQ(bands.RaysOf(band).begin, row);
        row = bands.RaysOf(band).end;
      }
      EXPECT_EQ(row, frustum.rows);
      for (int s = frustum.firstNodeSlice; s <= frustum.lastSlice; ++s)
      {
        int next = frustum.SliceAt(s).ownedRows.begin;
        for (int band = 0; band < bands.BandCount(); ++band)
        {
          const Range<int> voxels = bands.VoxelsOf(band, s);
          if (!voxels.Empty())
          {
            EXPECT_EQ(voxels.begin, next);
            next = voxels.end;
          }
        }
        EXPECT_EQ(next, frustum.SliceAt(s).ownedRows.end);
      }
    });
}

TEST_P(BandsOfRanks, HaveTheSameWork)
{
  this->ForFrusta(
    [this](const FaceFrustum& frustum, const RankBands& bands, const Occupancy&)
    {
      std::vector<Index> work(std::size_t(this->Ranks.Size()), 0);
      Index all = 0;
      Index largest = 0; // of a row
      for (int band = 0; band < bands.BandCount(); ++band)
      {
        for (int row = bands.RaysOf(band).begin; row < bands.RaysOf(band).end; ++row)
        {
          const Index ofRow = WorkOf(frustum, row);
          work[std::size_t(bands.RankOf(band))] += ofRow;
          all += ofRow;
          largest = std::max(largest, ofRow);
        }
      }
      for (const Index here : work)
      {
        // Rows are whole.
        EXPECT_LE(
          here, all / this->Ranks.Size() + largest * bands.BandCount() / this->Ranks.Size());
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
      // and what is filled need not lie as the rays that matter do.
      const Index rows = Index(frustum.nodesU) * frustum.SliceCount() * 4;
      EXPECT_LE(most,
        changed * 13 / 10 / this->Ranks.Size() + rows * bands.BandCount() / this->Ranks.Size());
    });
}

INSTANTIATE_TEST_SUITE_P(Ranks, BandsOfRanks, ::testing::Values(1, 2, 4, 8));
