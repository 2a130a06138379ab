// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Means of what rays carry over the hat functions of voxels.

#include "PlanSweep.h"
#include "RaySources.h"
#include "Tolerance.h"

#include "sweep/FrustumRays.h"
#include "sweep/HatMean.h"
#include "sweep/VoxelRow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <ostream>
#include <vector>

using namespace limpid;

namespace
{
struct Rays
{
  const char* name;
  RaySource eye;
  double density;
};

std::ostream& operator<<(std::ostream& stream, const Rays& rays)
{
  return stream << rays.name;
}

const Rays cases[] = {
  { "Point", PointAt(Vec3(9.3, 8.1, -40)), 1 },
  { "PointNearAFace", PointAt(Vec3(9.3, 8.1, -3)), 1.4 },
  { "Parallel", Parallel(Vec3(0, 0, 1)), 1.2 },
  { "ParallelDense", Parallel(Vec3(0, 0, 1)), 2.6 },
};

class MeanOf : public ::testing::TestWithParam<Rays>
{
protected:
  MeanOf()
  {
    this->grid.nodes = Int3(24, 19, 9);
    const std::vector<float> ones(std::size_t(this->grid.NodeCount()), 1.0f);
    const Occupancy everything(this->grid, ones.data(), ones.data(), false);
    this->frusta = PlanSweep(this->grid, everything, GetParam().eye, { GetParam().density });
  }

  using Field = std::function<double(double u, double v)>;
  using Check = std::function<void(int u, int v, double transmittance, double behind, double gap)>;

  /// Compares means at voxels whose neighbours all lie between rays that enter in front. The
  /// images are these functions of the rays' place on a slice. `gap`: between rays [index].
  void ForEachMean(const Field& transmittance, const Field& behind, const Check& check) const
  {
    for (const PlannedFrustum& frustum : this->frusta)
    {
      for (int s = frustum.firstNodeSlice; s <= frustum.lastSlice; ++s)
      {
        this->CheckSlice(frustum, s, transmittance, behind, check);
      }
    }
  }

  Grid grid;
  std::vector<PlannedFrustum> frusta;

private:
  static double Place(const Lateral& rays, int ray, const Slice& slice)
  {
    return rays.Position(rays.Coordinate(ray), slice.depth);
  }

  /// Voxels whose neighbours, or the border, lie between the rays of an interval.
  static Range<int> Between(
    const Lateral& rays, const Range<int>& entered, const Slice& slice, int nodes)
  {
    Range<int> voxels{ 0, nodes };
    while (
      voxels.begin < nodes && std::max(voxels.begin - 1, 0) < Place(rays, entered.begin, slice))
    {
      ++voxels.begin;
    }
    while (voxels.end > voxels.begin &&
      std::min(voxels.end, nodes - 1) > Place(rays, entered.end - 1, slice))
    {
      --voxels.end;
    }
    return voxels;
  }

  static double WidestGap(const Lateral& rays, const Slice& slice)
  {
    double gap = 0;
    for (int ray = 0; ray + 1 < rays.count; ++ray)
    {
      gap = std::max(gap, Place(rays, ray + 1, slice) - Place(rays, ray, slice));
    }
    return gap;
  }

  void CheckSlice(const PlannedFrustum& frustum, int s, const Field& transmittance,
    const Field& behind, const Check& check) const
  {
    const Slice& slice = frustum.SliceAt(s);
    RayImages<HostDevice> images(HostDevice::Shared(), frustum.RayCount());
    const RayStates states = images.States();
    for (int row = 0; row < frustum.rows; ++row)
    {
      for (int column = 0; column < frustum.columns; ++column)
      {
        const double u = Place(frustum.lateralU, column, slice);
        const double v = Place(frustum.lateralV, row, slice);
        const Index ray = frustum.RayAt(column, row);
        states[RayChannel::Transmittance][ray] = static_cast<float>(transmittance(u, v));
        states[RayChannel::Behind][ray] = static_cast<float>(behind(u, v));
      }
    }
    const Range<int> columns = Intersection(
      Between(frustum.lateralU, frustum.frontColumns, slice, frustum.nodesU), slice.ownedColumns);
    const Range<int> rows = Between(frustum.lateralV, frustum.frontRows, slice, frustum.nodesV);
    const double gap =
      std::max(WidestGap(frustum.lateralU, slice), WidestGap(frustum.lateralV, slice));
    for (int v = rows.begin; v < rows.end; ++v)
    {
      VoxelRow voxels(frustum, s, v);
      if (!voxels.FindSeen({ states[RayChannel::Transmittance], states[RayChannel::Density],
            states[RayChannel::Behind] }))
      {
        continue;
      }
      const SeenByVoxels seen = voxels.SeenHere();
      for (int u = columns.begin; u < columns.end; ++u)
      {
        check(u, v, seen.transmittance[u], seen.behind[u], gap);
      }
    }
  }
};

/// Mean of the coordinate over the hat function of node `k`.
double MeanPlace(int k, int nodes)
{
  return k + (k == 0 ? 1.0 / 3 : 0.0) - (k == nodes - 1 ? 1.0 / 3 : 0.0);
}
}

TEST_P(MeanOf, IsExactForWhatIsLinearEvenOnTheBorder)
{
  const auto linear = [](double u, double v) { return 0.3 + 0.01 * u + 0.02 * v; };
  int compared = 0;
  this->ForEachMean(
    linear, [](double, double) { return 0.7; },
    [&](int u, int v, double transmittance, double behind, double)
    {
      const double expected =
        linear(MeanPlace(u, this->grid.nodes.x), MeanPlace(v, this->grid.nodes.y));
      // Interpolation and means: eleven sums of products along either axis.
      ASSERT_WITHIN(transmittance, expected, Roundoff<float>(22, 1.0));
      ASSERT_WITHIN(behind, 0.7 * expected, Roundoff<float>(24, 1.0));
      ++compared;
    });
  EXPECT_GT(compared, this->grid.NodeCount() / 4);
}

TEST_P(MeanOf, CountsTheCurvatureOfTheProduct)
{
  const auto transmittance = [](double u, double) { return 0.2 + 0.03 * u; };
  const auto behind = [](double u, double) { return 0.1 + 0.02 * u; };
  this->ForEachMean(transmittance, behind,
    [&](int u, int v, double, double seen, double gap)
    {
      if (u == 0 || v == 0 || u + 1 == this->grid.nodes.x || v + 1 == this->grid.nodes.y)
      {
        return;
      }
      // The product is a parabola, whose mean over the hat is 1/12 of the second derivative above
      // its middle. That of the rays between which a voxel lies is up to gap^2 / 8 from those of
      // its neighbours, which have the weight 2 / 12 at most; rays too far apart for a mean
      // this narrow miss it by what they average too much.
      const double curvature = 2 * 0.03 * 0.02;
      const double expected = transmittance(u, v) * behind(u, v) + curvature / 12;
      const double neighbours = gap * gap / 8 / 6;
      const double tooFar = std::max(gap * gap / 8 - 1.0 / 12, 0.0);
      ASSERT_WITHIN(seen, expected,
        (Tolerance{ curvature * (neighbours + tooFar), "means between rays" }) +
          Roundoff<float>(24, 1.0));
    });
}

INSTANTIATE_TEST_SUITE_P(
  Rays, MeanOf, ::testing::ValuesIn(cases), [](const auto& rays) { return rays.param.name; });

// The rays on either side of a node, `share` of their gap away, and of its neighbours one node
// away, whose shares are the same when the gap is that of the nodes.
TEST(HatMean, IsThatOfAParabolaWhereverTheRaysLie)
{
  for (int step = 0; step <= 20; ++step)
  {
    const double share = step / 20.0;
    const double excess = share * (1 - share); // of linear interpolation of x^2
    const auto interpolated = [&](double x) { return static_cast<float>(x * x + excess); };

    const float side = SideWeight(static_cast<float>(share), 1.0f);
    const double mean = HatMean(interpolated(-1), interpolated(0), interpolated(1), side);

    const double expected = std::max(1.0 / 6, excess); // farther apart than the hat is wide
    EXPECT_GE(side, 0);
    EXPECT_WITHIN(mean, expected, Roundoff<float>(8, 1.0)) << "share " << share;
  }
}
