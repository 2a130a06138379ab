// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The tiles and layers that sweeps on a device visit.

#include "PlanOf.h"

#include "sweep/DimmedTiles.h"
#include "sweep/SweepTiles.h"

#include <algorithm>
#include <vector>

using namespace limpid;

namespace
{
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

/// Calls visit(ray) for the rays in some columns and rows.
template <class Visit>
void ForRaysIn(
  const FaceFrustum& plan, const Range<int>& columns, const Range<int>& rows, const Visit& visit)
{
  for (int row = rows.begin; row < rows.end; ++row)
  {
    for (int column = columns.begin; column < columns.end; ++column)
    {
      visit(std::size_t(plan.RayAt(column, row)));
    }
  }
}

/// Returns the tiles that a sweep visits in phase `number`. `next`: the next phase in its lists.
PhaseOfTiles PhaseAt(const PhasesOfTiles& lists, int number, int& next)
{
  const bool listed = next < *lists.phaseCount && lists.phases[next].number == number;
  return listed ? lists.phases[next++] : PhaseOfTiles{ number, 0, 0 };
}

/// Returns, per ray, whether it is moved in a phase, and calls found(tile) for tiles of voxels.
template <class Slabs, class Found>
std::vector<bool> RaysMovedIn(const PhaseOfTiles& phase, const SlabLayout<Slabs>& layout,
  const PhasesOfTiles& lists, const Found& found)
{
  const FaceFrustum& plan = layout.frustum;
  std::vector<bool> moved(std::size_t(plan.RayCount()), false);
  for (int index = 0; index < phase.count; ++index)
  {
    const SlabTile tile = layout.TileAt(phase.number, lists.numbers[phase.first + index]);
    if (!tile.hasRays)
    {
      found(tile);
      continue;
    }
    ForRaysIn(plan, tile.columns, tile.rows, [&moved](std::size_t ray) { moved[ray] = true; });
  }
  return moved;
}

/// Whether any of the nodes that a ray reads in the layer behind slice `s` has extinction.
bool MeetsAny(
  const FaceFrustum& plan, const std::vector<float>& extinction, int s, int column, int row)
{
  if (!plan.ActiveRays(s, row).Contains(column))
  {
    return false;
  }
  for (int corner = 0; corner < 16; ++corner)
  {
    const int plane = 2 * s + (corner & 1);
    const int u = plan.PlaneColumns(plane).index[column] + (corner >> 1 & 1);
    const int v = plan.PlaneRows(plane).index[row] + (corner >> 2 & 1);
    const int node = plan.SliceAt(s).nodes[corner >> 3];
    if (extinction[std::size_t(plan.VoxelAt(node, u, v))] > 0)
    {
      return true;
    }
  }
  return false;
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
    const PhasesOfTiles lists = rays.Tiles().Lists();
    const VoxelsOfTiles voxels = rays.Tiles().Found();
    std::vector<int> changes(std::size_t(plan.RayCount()), 0);
    std::vector<int> images[2] = { changes, changes };
    int phase = 0;
    for (int s = plan.lastSlice; s >= plan.firstNodeSlice - 1; --s)
    {
      const PhaseOfTiles here = PhaseAt(lists, plan.lastSlice - s, phase);
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
        ForRaysIn(plan, voxels.tiles.ColumnsOf(number), voxels.tiles.RowsOf(number),
          [&moved](std::size_t ray) { moved[ray] = true; });
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
    ASSERT_EQ(phase, *lists.phaseCount);
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
    const SlabLayout<SlabsFromBack> layout(plan, slices);
    const PhasesOfTiles lists = rays.SlabsFromBack(slices).Lists();
    std::vector<int> changes(std::size_t(plan.RayCount()), 0);
    std::vector<std::vector<int>> images(2 * slices, changes);
    int phase = 0;
    for (int number = 0; number <= layout.slabs; ++number)
    {
      const PhaseOfTiles here = PhaseAt(lists, number, phase);
      ASSERT_LE(here.count, lists.mostTiles);
      const Range<int> behind = number > 0 ? layout.SlabOf(number - 1) : Range<int>{};
      std::vector<VoxelCounts> finders(slices, VoxelCounts(plan));
      const std::vector<bool> moved = RaysMovedIn(here, layout, lists,
        [&](const SlabTile& tile)
        { finders[std::size_t(tile.place - behind.begin)].Add(tile.columns, tile.rows); });

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
      const Range<int> slab = number < layout.slabs ? layout.SlabOf(number) : Range<int>{};
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
    ASSERT_EQ(phase, *lists.phaseCount);
  }
}

// Front to back the image of a ray is another one behind every layer in which it meets anything,
// and, near the sides of the box, on every slice from the first such layer on.
TEST_P(PlanOf, VisitsAllTilesOfRaysWhoseImageChangesFrontToBack)
{
  constexpr int slices = 4;
  const auto device = SimulatedDevice::Shared();
  const std::vector<float>& extinction = this->scene.extinction;
  const FieldBlocks<SimulatedDevice> dimming(device, this->scene.grid.nodes, extinction.data());
  for (FrustumRays<SimulatedDevice>& rays : this->MoveToDevice())
  {
    const FaceFrustum& plan = rays.Plan();
    const SlabLayout<SlabsFromFront> layout(plan, slices);
    const auto made = ListSlabsFromFront(device, plan, slices, dimming.Blocks());
    const PhasesOfTiles lists = made.Lists();
    std::vector<int> met(std::size_t(plan.RayCount()), 0);
    std::vector<std::vector<int>> images(2 * slices, met);
    int phase = 0;
    for (int number = 0; number < layout.slabs; ++number)
    {
      const std::vector<bool> moved =
        RaysMovedIn(PhaseAt(lists, number, phase), layout, lists, [](const SlabTile&) {});
      const Range<int> slab = layout.SlabOf(number);
      for (int s = slab.begin; s < slab.end; ++s)
      {
        std::vector<int>& image = images[std::size_t(s % (2 * slices))];
        for (int row = 0; row < plan.rows; ++row)
        {
          for (int column = 0; column < plan.columns; ++column)
          {
            const auto ray = std::size_t(plan.RayAt(column, row));
            const bool meets = s < plan.lastSlice && MeetsAny(plan, extinction, s, column, row);
            ASSERT_TRUE(moved[ray] || !meets) << column << " " << row;
            const bool bySlice = plan.IsNearSides(column, row) && (met[ray] > 0 || meets);
            const int right = bySlice ? 1000 * (s + 1) + met[ray] : met[ray];
            image[ray] = moved[ray] ? right : image[ray];
            ASSERT_EQ(image[ray], right) << column << " " << row << " " << s;
            met[ray] += meets ? 1 : 0;
          }
        }
      }
    }
  }
}

TEST(FilledBlocks, AreThoseWithAnyValue)
{
  const Int3 nodes(9, 6, 5);
  for (const Int3& filled : { Int3(0, 0, 0), Int3(8, 5, 4), Int3(3, 4, 0), Int3(4, 3, 4) })
  {
    std::vector<float> field(std::size_t(nodes.x * nodes.y * nodes.z), 0.0f);
    field[std::size_t(filled.x + nodes.x * (filled.y + nodes.y * filled.z))] = 1;
    const FieldBlocks<SimulatedDevice> made(SimulatedDevice::Shared(), nodes, field.data());

    const FilledBlocks blocks = made.Blocks();

    EXPECT_EQ(blocks.counts, Int3(5, 3, 3));
    EXPECT_TRUE(blocks.Any({ Int3(0), nodes - 1 }));
    EXPECT_TRUE(blocks.Any({ filled, filled }));
    EXPECT_EQ(blocks.Any({ Int3(0), Int3(3) }), filled == Int3(0));
    EXPECT_EQ(blocks.Any({ Int3(8, 4, 4), Int3(8, 5, 4) }), filled == Int3(8, 5, 4));
  }
}

// The host would otherwise wait until the device has listed them, before every first sweep of a
// plan.
TEST_P(PlanOf, ListsTilesWithoutCopies)
{
  std::vector<FrustumRays<SimulatedDevice>> onDevice = this->MoveToDevice();
  LaunchTimes times;

  SimulatedDevice::Shared()->Time(&times);
  for (FrustumRays<SimulatedDevice>& rays : onDevice)
  {
    rays.Tiles();
    rays.SlabsFromBack(4);
  }
  SimulatedDevice::Shared()->Time(nullptr);

  ASSERT_EQ(times.Entries().size(), 1u);
  EXPECT_EQ(times.Entries()[0].label, "plan");
}

TEST(PhaseLists, HaveNoPhasesWhereNoTileHasWork)
{
  const auto nowhere = [](int, int) { return false; };
  const PhaseLists<SimulatedDevice> lists(SimulatedDevice::Shared(), 70, 5, nowhere);

  EXPECT_EQ(*lists.Lists().phaseCount, 0);
}

TEST(PhaseLists, LeaveOutPhasesWithoutTiles)
{
  const auto everyThird = [](int tile, int phase) { return phase % 2 == 1 && tile % 3 == 0; };
  const PhaseLists<SimulatedDevice> made(SimulatedDevice::Shared(), 200, 6, everyThird);

  const PhasesOfTiles lists = made.Lists();
  ASSERT_EQ(*lists.phaseCount, 3);
  for (int place = 0; place < 3; ++place)
  {
    const PhaseOfTiles& phase = lists.phases[place];
    EXPECT_EQ(phase.number, 2 * place + 1);
    ASSERT_EQ(phase.count, 67);
    for (int index = 0; index < phase.count; ++index)
    {
      ASSERT_EQ(lists.numbers[phase.first + index], 3 * index);
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
