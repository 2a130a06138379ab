// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "RaySources.h"
#include "SimulatedDevice.h"
#include "Tolerance.h"

#include "backend/Backend.h"
#include "sweep/PlanSweep.h"
#include "sweep/SweepTiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
/// Some boxes of extinction in the air, some of them important.
struct Boxes
{
  Grid grid;
  std::vector<float> extinction;
  std::vector<float> importance;

  explicit Boxes(const Int3& nodes)
  {
    this->grid.nodes = nodes;
    this->extinction.assign(std::size_t(this->grid.NodeCount()), 0.0f);
    this->importance.assign(std::size_t(this->grid.NodeCount()), 0.0f);
    std::size_t node = 0;
    for (int k = 0; k < nodes.z; ++k)
    {
      for (int j = 0; j < nodes.y; ++j)
      {
        for (int i = 0; i < nodes.x; ++i, ++node)
        {
          const bool box = i % 9 < 2 && (j + i) % 11 < 3 && k % 7 < 2;
          this->extinction[node] = box ? 1.0f : 0.0f;
          this->importance[node] = box && i > nodes.x / 2 && k % 14 < 7 ? 1.0f : 0.0f;
        }
      }
    }
  }

  Occupancy MakeOccupancy() const
  {
    return Occupancy(this->grid, this->extinction.data(), this->importance.data(), true);
  }
};

struct Viewing
{
  const char* name;
  RaySource eye;
  double rayDensity = 1;
  RayPlacement placement = RayPlacement::ForIntegrals;
};

std::ostream& operator<<(std::ostream& stream, const Viewing& viewing)
{
  return stream << viewing.name;
}

const Int3 nodes(31, 24, 27);

const Viewing viewings[] = {
  { "Oblique", PointAt(Vec3(60, -35, -50)) },
  { "OnTheAxis", PointAt(Vec3(15, 11.5, -40)) },
  { "InFrontOfAFace", PointAt(Vec3(9.3, 8.1, -0.3)), 2.3 },
  { "OnAFace", PointAt(Vec3(0, 8.1, 11)) },
  { "Inside", PointAt(Vec3(9.3, 11.9, 14.2)), 1.7 },
  { "OnAVoxel", PointAt(Vec3(9, 11, 14)), 1, RayPlacement::ForNodes },
  { "FarAway", PointAt(Vec3(3e7, 2e7, -4e7)) },
  { "FewRays", PointAt(Vec3(-30, 60, 13)), 0.2 },
  { "Parallel", Parallel(Vec3(0.4, -0.3, 0.9)) },
  { "ParallelAlongTheAxis", Parallel(Vec3(0, 1, 0)), 1, RayPlacement::ForNodes },
  { "ParallelAlongTheDiagonal", Parallel(Vec3(-1, 1, -1)), 3, RayPlacement::ForNodes },
};

class PlanOf : public ::testing::TestWithParam<Viewing>
{
protected:
  PlanOf()
    : scene(nodes)
    , frusta(PlanSweep(this->scene.grid, this->scene.MakeOccupancy(), GetParam().eye,
        { GetParam().rayDensity, GetParam().placement }))
  {
  }

  std::vector<FrustumRays<SimulatedDevice>> MoveToDevice() const
  {
    return PlanRays(SimulatedDevice::Shared(), this->scene.grid, this->scene.MakeOccupancy(),
      GetParam().eye, { GetParam().rayDensity, GetParam().placement });
  }

  Boxes scene;
  std::vector<PlannedFrustum> frusta;
};

/// Whether a place along a lateral axis is in the box at a depth.
bool IsInside(const Lateral& lateral, int ray, double depth)
{
  const double position = lateral.Position(lateral.Coordinate(ray), depth);
  return position >= 0 && position <= lateral.nodes - 1;
}

/// Whether a ray meets anything of a field at a Gauss point of the layer behind a slice.
bool Meets(const Boxes& scene, const std::vector<float>& field, const PlannedFrustum& frustum,
  int s, int half, int column, int row)
{
  const Slice& slice = frustum.SliceAt(s);
  const double thickness = frustum.SliceAt(s + 1).depth - slice.depth;
  const double depth = slice.depth + gaussPoints[half] * thickness;
  if (!IsInside(frustum.lateralU, column, depth) || !IsInside(frustum.lateralV, row, depth))
  {
    return false;
  }
  const LinearMap columns = frustum.PlaneColumns(2 * s + half);
  const LinearMap rows = frustum.PlaneRows(2 * s + half);
  for (int corner = 0; corner < 8; ++corner)
  {
    Int3 node(0);
    node[frustum.axisU] = columns.index[column] + corner % 2;
    node[frustum.axisV] = rows.index[row] + corner / 2 % 2;
    node[frustum.axisW] = slice.nodes[corner / 4];
    const Int3& count = scene.grid.nodes;
    if (field[std::size_t((Index(node.z) * count.y + node.y) * count.x + node.x)] > 0)
    {
      return true;
    }
  }
  return false;
}

/// Per ray of a frustum, whether it meets anything of a field in the layer behind a slice.
std::vector<bool> RaysThatMeet(
  const Boxes& scene, const std::vector<float>& field, const PlannedFrustum& frustum, int s)
{
  std::vector<bool> meets;
  for (int row = 0; row < frustum.rows; ++row)
  {
    for (int column = 0; column < frustum.columns; ++column)
    {
      meets.push_back(Meets(scene, field, frustum, s, 0, column, row) ||
        Meets(scene, field, frustum, s, 1, column, row));
    }
  }
  return meets;
}

/// Whether a ray or one beside it is marked.
bool AnyNear(const PlannedFrustum& frustum, const std::vector<bool>& rays, int column, int row)
{
  for (int j = std::max(row - 1, 0); j <= std::min(row + 1, frustum.rows - 1); ++j)
  {
    for (int i = std::max(column - 1, 0); i <= std::min(column + 1, frustum.columns - 1); ++i)
    {
      if (rays[std::size_t(j) * std::size_t(frustum.columns) + std::size_t(i)])
      {
        return true;
      }
    }
  }
  return false;
}

/// What is swept in tiles does not matter to where they are.
/// A number for every voxel of a slice.
class VoxelCounts
{
public:
  explicit VoxelCounts(const FaceFrustum& plan)
    : NodesU(plan.nodesU)
    , Counts(std::size_t(plan.nodesU) * std::size_t(plan.nodesV), 0)
  {
  }

  void Add(const Range<int>& columns, const Range<int>& rows)
  {
    for (int v = rows.begin; v < rows.end; ++v)
    {
      for (int u = columns.begin; u < columns.end; ++u)
      {
        ++this->Counts[this->IndexOf(u, v)];
      }
    }
  }

  int At(int u, int v) const { return this->Counts[this->IndexOf(u, v)]; }

private:
  std::size_t IndexOf(int u, int v) const
  {
    return std::size_t(v) * std::size_t(this->NodesU) + std::size_t(u);
  }

  int NodesU;
  std::vector<int> Counts;
};

/// Calls visit(ray) for the rays of a tile.
template <class Visit>
void ForRaysOf(const FaceFrustum& plan, const RayTiles& tiles, int number, const Visit& visit)
{
  const Range<int> columns = tiles.ColumnsOf(number);
  const Range<int> rows = tiles.RowsOf(number);
  for (int row = rows.begin; row < rows.end; ++row)
  {
    for (int column = columns.begin; column < columns.end; ++column)
    {
      visit(std::size_t(plan.RayAt(column, row)));
    }
  }
}

/// Rays along one axis.
struct Axis
{
  const MapTable& planes;
  Range<int> Slice::*described;
  const RayLine* lines;
  int nodes;
};

/// Whether all voxels of slice `s` along one axis that the rays read are among those `found`, as
/// far as they are `owned`: at Gauss points, and anywhere in the layer behind, which a ray that
/// enters or leaves there resolves.
bool FindsAll(const FaceFrustum& plan, const Axis& axis, int s, const Range<int>& rays,
  const Range<int>& owned, const Range<int>& found)
{
  const auto finds = [&](int first)
  {
    for (const int node : { first, first + 1 })
    {
      if (owned.Contains(node) && !found.Contains(node))
      {
        return false;
      }
    }
    return true;
  };
  for (int ray = rays.begin; s < plan.lastSlice && ray < rays.end; ++ray)
  {
    const Layer& layer = plan.SliceAt(s).layer;
    for (const double share : { 0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99 })
    {
      const double depth = layer.front + share * layer.thickness;
      if (!finds(NodesAt(axis.lines[ray].At(depth), axis.nodes).first))
      {
        return false;
      }
    }
  }
  for (int layer = std::max(s - 1, 0); layer <= std::min(s, plan.lastSlice - 1); ++layer)
  {
    const Range<int>& described = plan.SliceAt(layer).*axis.described;
    const Range<int> some = Intersection(rays, described);
    for (int ray = some.begin; ray < some.end; ++ray)
    {
      for (const int half : { 0, 1 })
      {
        if (!finds(plan.Row(axis.planes, 2 * layer + half).index[ray - described.begin]))
        {
          return false;
        }
      }
    }
  }
  return true;
}
}

// What a ray meets in a layer matters if there is something important there or behind, on the ray
// itself or on one beside it, which a voxel may read together with it.
TEST_P(PlanOf, LeavesOutNothingThatMatters)
{
  for (const PlannedFrustum& frustum : this->frusta)
  {
    std::vector<bool> importantBehind(
      std::size_t(frustum.columns) * std::size_t(frustum.rows), false);
    for (int s = frustum.lastSlice - 1; s >= 0; --s)
    {
      const std::vector<bool> filled =
        RaysThatMeet(this->scene, this->scene.extinction, frustum, s);
      const std::vector<bool> important =
        RaysThatMeet(this->scene, this->scene.importance, frustum, s);
      std::transform(important.begin(), important.end(), importantBehind.begin(),
        importantBehind.begin(), [](bool one, bool other) { return one || other; });
      for (int row = 0; row < frustum.rows; ++row)
      {
        const Range<int>& active = frustum.ActiveRays(s, row);
        for (int column = 0; column < frustum.columns; ++column)
        {
          const bool visited = active.Contains(column);
          const auto ray = std::size_t(row) * std::size_t(frustum.columns) + std::size_t(column);
          ASSERT_TRUE(visited || !filled[ray] || !AnyNear(frustum, importantBehind, column, row))
            << "ray " << column << ", " << row << " at slice " << s;
        }
      }
    }
  }
}

TEST_P(PlanOf, LeavesOutMuchOfASparseScene)
{
  Index visited = 0;
  Index all = 0;
  for (const PlannedFrustum& frustum : this->frusta)
  {
    all += frustum.RayCount() * frustum.lastSlice;
    for (int s = 0; s <= frustum.lastSlice; ++s)
    {
      for (int row = 0; row < frustum.rows; ++row)
      {
        visited += std::max(frustum.ActiveRays(s, row).Length(), 0);
      }
    }
  }

  EXPECT_LT(visited, all);
}

TEST_P(PlanOf, KnowsTheVoxelsBetweenWhichEveryRayRuns)
{
  for (const PlannedFrustum& frustum : this->frusta)
  {
    for (int s = 0; s < frustum.lastSlice; ++s)
    {
      const Slice& slice = frustum.SliceAt(s);
      const double thickness = frustum.SliceAt(s + 1).depth - slice.depth;
      for (int half = 0; half < 2; ++half)
      {
        const LinearMap map = frustum.PlaneColumns(2 * s + half);
        const double depth = slice.depth + gaussPoints[half] * thickness;
        for (int column = slice.rayColumns.begin; column < slice.rayColumns.end; ++column)
        {
          const int ray = column;
          const double position =
            frustum.lateralU.Position(frustum.lateralU.Coordinate(column), depth);
          const double inside = std::min(std::max(position, 0.0), frustum.nodesU - 1.0);
          ASSERT_GE(map.index[ray], 0);
          ASSERT_LE(map.index[ray], frustum.nodesU - 2);
          ASSERT_WITHIN(double(map.weight[ray]) + map.index[ray], inside, Roundoff<float>(1, 1.0));
        }
      }
    }
  }
}

TEST_P(PlanOf, KnowsTheRaysBetweenWhichEveryVoxelLies)
{
  for (const PlannedFrustum& frustum : this->frusta)
  {
    for (int s = frustum.firstNodeSlice; s <= frustum.lastSlice; ++s)
    {
      const Slice& slice = frustum.SliceAt(s);
      const Lateral& rays = frustum.lateralV;
      for (int v = 0; v < frustum.nodesV; ++v)
      {
        const int ray = frustum.Row(frustum.voxelRows, s).index[v];
        const double weight = frustum.Row(frustum.voxelRows, s).weight[v];
        ASSERT_GE(ray, 0);
        ASSERT_LE(ray, frustum.rows - 2);
        const double before = rays.Position(rays.Coordinate(ray), slice.depth);
        const double behind = rays.Position(rays.Coordinate(ray + 1), slice.depth);
        const double first = rays.Position(rays.Coordinate(0), slice.depth);
        const double last = rays.Position(rays.Coordinate(frustum.rows - 1), slice.depth);
        const double nearest = std::min(std::max(double(v), first), last);
        const double size = std::abs(rays.eye) + std::abs(rays.shear) * slice.depth + last - first;
        ASSERT_WITHIN(before + weight * (behind - before), nearest,
          Roundoff<float>(1, behind - before) + Roundoff<double>(16, size));
      }
    }
  }
}

TEST_P(PlanOf, KnowsWhereTheRaysOfVoxelsEnterTheBox)
{
  constexpr float never = 1e30f;
  for (const PlannedFrustum& frustum : this->frusta)
  {
    for (int s = frustum.firstNodeSlice; s <= frustum.lastSlice; ++s)
    {
      const Slice& slice = frustum.SliceAt(s);
      const Lateral& rays = frustum.lateralU;
      const double base = slice.depth - slice.RelativeDepth();
      for (int u = 0; u < frustum.nodesU; ++u)
      {
        const float entry = frustum.Row(frustum.voxelColumnEntry, s)[u];
        const double fromEye = rays.parallel ? rays.shear : (u - rays.eye) / slice.depth;
        if (fromEye == 0)
        {
          ASSERT_EQ(entry, -never);
          continue;
        }
        // Where the ray comes from, it passes the side that it moves away from.
        const double side = fromEye > 0 ? 0 : frustum.nodesU - 1;
        const double expected = slice.depth + (side - u) / fromEye - base;
        const double size = std::abs(expected) + slice.depth +
          (std::abs(rays.eye) + frustum.nodesU) / std::abs(fromEye);
        ASSERT_WITHIN(entry, std::max(expected, -1e30),
          Roundoff<float>(2, expected) + Roundoff<double>(16, size));
      }
    }
  }
}

// So that a tile waits for no other; and every voxel is found by one of them at least.
TEST_P(PlanOf, GivesTilesOfRaysAllVoxelsThatTheyRead)
{
  for (FrustumRays<SimulatedDevice>& rays : this->MoveToDevice())
  {
    const FaceFrustum& plan = rays.Plan();
    const VoxelsOfTiles voxels = rays.Tiles().Found();
    for (int s = plan.firstNodeSlice; s <= plan.lastSlice; ++s)
    {
      const Slice& slice = plan.SliceAt(s);
      VoxelCounts finders(plan);
      for (int number = 0; number < voxels.tiles.Count(); ++number)
      {
        const Range<int> columns = voxels.AlongU(s, number);
        const Range<int> rows = voxels.AlongV(s, number);
        ASSERT_TRUE(FindsAll(plan,
          { plan.planeColumns, &Slice::rayColumns, plan.Row(plan.columnLines), plan.nodesU }, s,
          voxels.tiles.ColumnsOf(number), slice.ownedColumns, columns));
        ASSERT_TRUE(
          FindsAll(plan, { plan.planeRows, &Slice::rayRows, plan.Row(plan.rowLines), plan.nodesV },
            s, voxels.tiles.RowsOf(number), slice.ownedRows, rows));
        finders.Add(columns, rows);
      }
      for (int v = 0; v < plan.nodesV; ++v)
      {
        for (int u = 0; u < plan.nodesU; ++u)
        {
          const bool owned = slice.ownedColumns.Contains(u) && slice.ownedRows.Contains(v);
          ASSERT_EQ(finders.At(u, v) > 0, owned) << u << " " << v;
        }
      }
    }
  }
}

// A ray is moved where it may change, and as long as its image on the slice is an old one: images
// of two slices take turns. All voxels are found that rays matter to.
TEST_P(PlanOf, VisitsAllTilesThatHaveAnythingToDo)
{
  for (FrustumRays<SimulatedDevice>& rays : this->MoveToDevice())
  {
    const FaceFrustum& plan = rays.Plan();
    const PhasesOfTiles& lists = rays.Tiles().Lists();
    const VoxelsOfTiles voxels = rays.Tiles().Found();
    std::vector<int> changes(std::size_t(plan.RayCount()), 0);
    std::vector<int> images[2] = { changes, changes };
    int phase = 0;
    for (int s = plan.lastSlice; s >= plan.firstNodeSlice - 1; --s)
    {
      const PhaseOfTiles here =
        phase < lists.phaseCount && lists.phases[phase].number == plan.lastSlice - s
        ? lists.phases[phase++]
        : PhaseOfTiles{ plan.lastSlice - s, 0, 0 };
      ASSERT_LE(here.count, lists.mostTiles);
      VoxelCounts finders(plan);
      std::vector<bool> moved(changes.size(), false);
      for (int index = 0; index < here.count; ++index)
      {
        const int number = lists.numbers[here.first + index];
        if (s < plan.lastSlice)
        {
          finders.Add(voxels.AlongU(s + 1, number), voxels.AlongV(s + 1, number));
        }
        ForRaysOf(plan, voxels.tiles, number, [&](std::size_t ray) { moved[ray] = true; });
      }

      for (int v = 0; s < plan.lastSlice && v < plan.nodesV; ++v)
      {
        const Range<int> active = plan.ActiveVoxels(s + 1, v);
        for (int u = active.begin; u < active.end; ++u)
        {
          ASSERT_GT(finders.At(u, v), 0) << u << " " << v;
        }
      }
      for (int row = 0; s >= plan.firstNodeSlice && row < plan.rows; ++row)
      {
        for (int column = 0; column < plan.columns; ++column)
        {
          const auto ray = std::size_t(plan.RayAt(column, row));
          const bool active = plan.ActiveRays(s, row).Contains(column) ||
            (s < plan.lastSlice && plan.ActiveRays(s + 1, row).Contains(column));
          ASSERT_TRUE(moved[ray] || !active) << column << " " << row;
          changes[ray] += active ? 1 : 0;
          int& image = images[s & 1][ray];
          image = moved[ray] ? changes[ray] : image;
          ASSERT_EQ(image, changes[ray]) << column << " " << row;
        }
      }
    }
    ASSERT_EQ(phase, lists.phaseCount);
  }
}

// As above, by slabs: the image of a ray is another one beside every layer in which the ray is
// active, and behind these one that stays.
TEST_P(PlanOf, VisitsAllTilesOfSlabsThatHaveAnythingToDo)
{
  constexpr int slices = 4;
  for (FrustumRays<SimulatedDevice>& rays : this->MoveToDevice())
  {
    const FaceFrustum& plan = rays.Plan();
    const SlabTiles tiles(plan, slices);
    const int slabs = tiles.SlabsOf(SlabsFromBack::SlicesOf(plan));
    const PhasesOfTiles& lists = rays.SlabsFromBack(slices).Lists();
    const auto slabOf = [&](int slab) { return SlabsFromBack::SlabOf(plan, slices, slab); };
    std::vector<int> changes(std::size_t(plan.RayCount()), 0);
    std::vector<std::vector<int>> images(2 * slices, changes);
    int phase = 0;
    for (int number = 0; number <= slabs; ++number)
    {
      const PhaseOfTiles here = phase < lists.phaseCount && lists.phases[phase].number == number
        ? lists.phases[phase++]
        : PhaseOfTiles{ number, 0, 0 };
      ASSERT_LE(here.count, lists.mostTiles);
      std::vector<VoxelCounts> finders(slices, VoxelCounts(plan));
      std::vector<bool> moved(changes.size(), false);
      for (int index = 0; index < here.count; ++index)
      {
        const SlabTile tile =
          SlabTileAt<SlabsFromBack>(plan, tiles, slabs, number, lists.numbers[here.first + index]);
        if (!tile.hasRays)
        {
          finders[std::size_t(tile.place - slabOf(number - 1).begin)].Add(tile.columns, tile.rows);
          continue;
        }
        for (int row = tile.rows.begin; row < tile.rows.end; ++row)
        {
          for (int column = tile.columns.begin; column < tile.columns.end; ++column)
          {
            moved[std::size_t(plan.RayAt(column, row))] = true;
          }
        }
      }

      const Range<int> behind = number > 0 ? slabOf(number - 1) : Range<int>{};
      for (int s = behind.begin; s < behind.end; ++s)
      {
        for (int v = 0; v < plan.nodesV; ++v)
        {
          const Range<int> active = plan.ActiveVoxels(s, v);
          for (int u = active.begin; u < active.end; ++u)
          {
            ASSERT_EQ(finders[std::size_t(s - behind.begin)].At(u, v), 1) << u << " " << v;
          }
        }
      }
      const Range<int> slab = number < slabs ? slabOf(number) : Range<int>{};
      for (int s = slab.end; s-- > slab.begin;)
      {
        std::vector<int>& image = images[std::size_t(s % (2 * slices))];
        for (int row = 0; row < plan.rows; ++row)
        {
          for (int column = 0; column < plan.columns; ++column)
          {
            const auto ray = std::size_t(plan.RayAt(column, row));
            const bool changesHere = plan.ActiveRays(s, row).Contains(column) ||
              (s > 0 && plan.ActiveRays(s - 1, row).Contains(column));
            changes[ray] += changesHere ? 1 : 0;
            const int right = changesHere ? -changes[ray] : changes[ray];
            ASSERT_TRUE(moved[ray] || !changesHere) << column << " " << row;
            image[ray] = moved[ray] ? right : image[ray];
            ASSERT_EQ(image[ray], right) << column << " " << row;
          }
        }
      }
    }
    ASSERT_EQ(phase, lists.phaseCount);
  }
}

// Front to back the image of a ray is another one behind every layer in which it is active, and,
// near the sides of the box, on every slice from the first such layer on.
TEST_P(PlanOf, VisitsAllTilesOfRaysWhoseImageChangesFrontToBack)
{
  constexpr int slices = 4;
  for (FrustumRays<SimulatedDevice>& rays : this->MoveToDevice())
  {
    const FaceFrustum& plan = rays.Plan();
    const SlabTiles tiles(plan, slices);
    const int slabs = tiles.SlabsOf(SlabsFromFront::SlicesOf(plan));
    const PhasesOfTiles& lists = rays.SlabsFromFront(slices).Lists();
    std::vector<int> met(std::size_t(plan.RayCount()), 0);
    std::vector<std::vector<int>> images(2 * slices, met);
    int phase = 0;
    for (int number = 0; number < slabs; ++number)
    {
      std::vector<bool> moved(met.size(), false);
      const bool listed = phase < lists.phaseCount && lists.phases[phase].number == number;
      for (int index = 0; listed && index < lists.phases[phase].count; ++index)
      {
        const SlabTile tile = SlabTileAt<SlabsFromFront>(
          plan, tiles, slabs, number, lists.numbers[lists.phases[phase].first + index]);
        for (int row = tile.rows.begin; tile.hasRays && row < tile.rows.end; ++row)
        {
          for (int column = tile.columns.begin; column < tile.columns.end; ++column)
          {
            moved[std::size_t(plan.RayAt(column, row))] = true;
          }
        }
      }
      phase += listed ? 1 : 0;
      const Range<int> slab = SlabsFromFront::SlabOf(plan, slices, number);
      for (int s = slab.begin; s < slab.end; ++s)
      {
        std::vector<int>& image = images[std::size_t(s % (2 * slices))];
        for (int row = 0; row < plan.rows; ++row)
        {
          for (int column = 0; column < plan.columns; ++column)
          {
            const auto ray = std::size_t(plan.RayAt(column, row));
            const bool active = s < plan.lastSlice && plan.ActiveRays(s, row).Contains(column);
            ASSERT_TRUE(moved[ray] || !active) << column << " " << row;
            const bool bySlice = plan.IsNearSides(column, row) && (met[ray] > 0 || active);
            const int right = bySlice ? 1000 * (s + 1) + met[ray] : met[ray];
            image[ray] = moved[ray] ? right : image[ray];
            ASSERT_EQ(image[ray], right) << column << " " << row << " " << s;
            met[ray] += active ? 1 : 0;
          }
        }
      }
    }
  }
}

// Sweeps of whole rays visit the layers in which their group of rays is active, in order.
TEST_P(PlanOf, KnowsTheLayersInWhichRaysAreActive)
{
  for (FrustumRays<SimulatedDevice>& rays : this->MoveToDevice())
  {
    const FaceFrustum& plan = rays.Plan();
    const LayerMasks& masks = rays.Layers();
    for (int row = 0; row < plan.rows; ++row)
    {
      for (int column = 0; column < plan.columns; ++column)
      {
        const int group = column / LayerMasks::groupColumns;
        const Range<int> columns{ group * LayerMasks::groupColumns,
          (group + 1) * LayerMasks::groupColumns };
        std::vector<int> right;
        for (int s = 0; s < plan.lastSlice; ++s)
        {
          if (!Intersection(plan.ActiveRays(s, row), columns).Empty())
          {
            right.push_back(s);
          }
        }
        std::vector<int> found;
        masks.FrontToBack(column, row, [&](int layer) { found.push_back(layer); });
        ASSERT_EQ(found, right) << column << " " << row;
        found.clear();
        masks.BackToFront(column, row, [&](int layer) { found.push_back(layer); });
        std::reverse(right.begin(), right.end());
        ASSERT_EQ(found, right) << column << " " << row;
      }
    }
  }
}

TEST_P(PlanOf, IsTheSameOnOneThread)
{
  const ThreadLimit one(1);

  const std::vector<PlannedFrustum> again = PlanSweep(this->scene.grid, this->scene.MakeOccupancy(),
    GetParam().eye, { GetParam().rayDensity, GetParam().placement });

  ASSERT_EQ(again.size(), this->frusta.size());
  for (std::size_t index = 0; index < again.size(); ++index)
  {
    const PlannedFrustum& first = again[index];
    const PlannedFrustum& second = this->frusta[index];
    ASSERT_EQ(first.lastSlice, second.lastSlice);
    ASSERT_EQ(first.bytes, second.bytes);
    for (int s = 0; s <= first.lastSlice; ++s)
    {
      const Slice& here = first.SliceAt(s);
      const Slice& other = second.SliceAt(s);
      for (int row = 0; row < first.rows; ++row)
      {
        EXPECT_EQ(first.ActiveRays(s, row).begin, second.ActiveRays(s, row).begin);
        EXPECT_EQ(first.ActiveRays(s, row).end, second.ActiveRays(s, row).end);
      }
      EXPECT_EQ(here.touchedColumns.begin, other.touchedColumns.begin);
      EXPECT_EQ(here.touchedColumns.end, other.touchedColumns.end);
      EXPECT_EQ(here.touchedRows.begin, other.touchedRows.begin);
      EXPECT_EQ(here.touchedRows.end, other.touchedRows.end);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
  Eyes, PlanOf, ::testing::ValuesIn(viewings), ::testing::PrintToStringParamName());
