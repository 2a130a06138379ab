// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Transposed slices: what rays read is the field, whatever was in their memory before.

#include "sweep/BandDecomposition.h"
#include "sweep/Registers.h"
#include "sweep/SliceWindow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

using namespace limpid;

namespace
{
/// Two fields that are 0 at the same nodes, mostly, as seen by an eye on the x axis.
struct SlicedScene
{
  Grid grid;
  std::vector<float> fields[2];
  std::vector<PlannedFrustum> frusta;

  explicit SlicedScene(double eyeX)
  {
    this->grid.nodes = { 75, 61, 23 };
    for (std::vector<float>& field : this->fields)
    {
      field.assign(std::size_t(this->grid.NodeCount()), 0.0f);
    }
    for (int k = 0; k < this->grid.nodes.z; ++k)
    {
      for (int j = 0; j < this->grid.nodes.y; ++j)
      {
        for (int i = 0; i < this->grid.nodes.x; ++i)
        {
          if (this->Filled(i, j, k))
          {
            this->fields[0][this->Node(i, j, k)] = float(i + 100 * j + 10000 * k);
            this->fields[1][this->Node(i, j, k)] = float((i * j + k) % 5);
          }
        }
      }
    }
    RaySource eye;
    eye.origin = { eyeX, 28, 11 };
    this->frusta = PlanSweep(this->grid, this->MakeOccupancy(), eye,
      { 1, RayPlacement::ForIntegrals, nullptr, Readers::RaysAndVoxels,
        { { true, false, false } } });
  }

  Occupancy MakeOccupancy() const
  {
    return Occupancy(this->grid, this->fields[0].data(), this->fields[1].data(), true);
  }

  std::size_t Node(int i, int j, int k) const
  {
    return (std::size_t(k) * this->grid.nodes.y + j) * this->grid.nodes.x + i;
  }

private:
  /// Another part of every row, at some distances from the eye only.
  bool Filled(int i, int j, int k) const
  {
    const int begin = (7 * i + 3 * k) % 40;
    return i % 32 < 20 && k % 4 > 0 && j >= begin && j < begin + 15;
  }
};

/// Moves a window through all slabs from the back and counts the values that are not the field's.
/// `scribble`: writes where nothing is kept, too, as derivatives do.
int WrongValues(
  const SlicedScene& scene, const std::vector<float>& field, SlabPool& pool, bool scribble)
{
  const FaceFrustum& frustum = scene.frusta.front();
  const Occupancy occupancy = scene.MakeOccupancy();
  const BandDecomposition bands(frustum, *ThisProcess());
  SliceWindow window(frustum, bands, nullptr, &occupancy, pool, field.data(), { 1 });
  const std::vector<Range<int>> slabs = SlabsOf(frustum, frustum.axisW == 0);
  int wrong = 0;
  for (std::size_t index = slabs.size(); index-- > 0;)
  {
    const Range<int>& slab = slabs[index];
    window.Load(slab);
    for (int s = slab.begin; s < std::min(slab.end + 1, frustum.SliceCount()); ++s)
    {
      const Slice& slice = frustum.SliceAt(s);
      for (int v = slice.touchedRows.begin; v < slice.touchedRows.end; ++v)
      {
        float* row = window.Row(slice.node, v);
        for (int u = slice.touchedColumns.begin; u < slice.touchedColumns.end; ++u)
        {
          wrong += row[u] == field[scene.Node(slice.node, u, v)] ? 0 : 1;
        }
        const Range<int> owned = slice.ownedColumns;
        const Range<int> filled =
          Intersection(SpansOf(frustum, occupancy, slice.node)[v].filled, owned);
        const Range<int> written = WholeRegisters(filled, owned);
        if (scribble && s < slab.end && !filled.Empty())
        {
          std::fill(row + written.begin, row + filled.begin, 3.0f);
          std::fill(row + filled.end, row + written.end, 4.0f);
        }
      }
    }
  }
  return wrong;
}
}

TEST(SliceWindow, AreTheFieldWhateverWasThereBefore)
{
  for (const double eyeX : { -60.0, 140.0 })
  {
    const SlicedScene scene(eyeX);
    ASSERT_EQ(scene.frusta.size(), 1u);
    ASSERT_EQ(scene.frusta.front().axisW, 0);
    SlabPool pool;
    for (int round = 0; round < 3; ++round)
    {
      EXPECT_EQ(WrongValues(scene, scene.fields[0], pool, true), 0) << eyeX << ", " << round;
      EXPECT_EQ(WrongValues(scene, scene.fields[1], pool, round > 0), 0) << eyeX << ", " << round;
    }
  }
}

TEST(SliceWindow, TwoWindowsDoNotShareMemory)
{
  const SlicedScene scene(-60.0);
  const FaceFrustum& frustum = scene.frusta.front();
  SlabPool pool;
  const std::shared_ptr<SlabMemory> first = pool.Take(frustum);
  std::shared_ptr<SlabMemory> second = pool.Take(frustum);
  EXPECT_NE(first, second);
  const SlabMemory* released = second.get();
  second.reset();
  EXPECT_EQ(pool.Take(frustum).get(), released) << "is kept for the next";
}
