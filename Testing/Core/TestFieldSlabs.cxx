// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Copied slices: what rays read is the field, whatever was in their memory before.

#include "PlanSweep.h"

#include "sweep/BandDecomposition.h"
#include "sweep/FieldSlabs.h"
#include "sweep/Registers.h"
#include "sweep/VoxelSpans.h"

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
      { 1, RayPlacement::ForIntegrals, Readers::RaysAndVoxels, { { true, false, false } } });
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

/// The slices of the only frustum of a scene as transposed copies, and as copies that are
/// redistributed by a process alone.
std::vector<std::unique_ptr<FieldSlabs>> CopiesOf(
  const SlicedScene& scene, const BandDecomposition& bands, const Occupancy& occupancy)
{
  const FaceFrustum& frustum = scene.frusta.front();
  const NodeBox all = NodeBox::Of(scene.grid.nodes);
  const FieldLayout home(*ThisProcess(), all, { { all } }, { { all } });
  std::vector<std::unique_ptr<FieldSlabs>> copies;
  copies.push_back(FieldSlabs::Local(frustum, bands));
  copies.push_back(FieldSlabs::Redistributed(frustum, bands, home, &occupancy, 0));
  return copies;
}

/// Moves a window through all slabs from the back and counts the values that are not the field's.
/// `scribble`: writes where nothing is kept, too, as derivatives do.
int WrongValues(
  const SlicedScene& scene, std::vector<float> field, FieldSlabs& fields, bool scribble)
{
  const FaceFrustum& frustum = scene.frusta.front();
  const Occupancy occupancy = scene.MakeOccupancy();
  FieldSlabs::Windows windows{ fields.Open(field.data(), { 1 }) };
  const std::vector<Range<int>>& slabs = fields.Slabs();
  int wrong = 0;
  for (std::size_t index = slabs.size(); index-- > 0;)
  {
    const Range<int>& slab = slabs[index];
    fields.Load(slab, &occupancy, windows);
    for (int s = slab.begin; s < std::min(slab.end + 1, frustum.SliceCount()); ++s)
    {
      const Slice& slice = frustum.SliceAt(s);
      for (int v = slice.touchedRows.begin; v < slice.touchedRows.end; ++v)
      {
        float* row = windows.front().Row(slice.node, v);
        for (int u = slice.touchedColumns.begin; u < slice.touchedColumns.end; ++u)
        {
          wrong += row[u] == field[scene.Node(slice.node, u, v)] ? 0 : 1;
        }
        const Range<int> owned = slice.ownedColumns;
        const Range<int> filled = Intersection(
          SpansOf(frustum, occupancy.Along(frustum.axisU), slice.node)[v].filled, owned);
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

TEST(FieldSlabs, AreTheFieldWhateverWasThereBefore)
{
  for (const double eyeX : { -60.0, 140.0 })
  {
    const SlicedScene scene(eyeX);
    ASSERT_EQ(scene.frusta.size(), 1u);
    ASSERT_EQ(scene.frusta.front().axisW, 0);
    const BandDecomposition bands(scene.frusta.front(), *ThisProcess());
    const Occupancy occupancy = scene.MakeOccupancy();
    for (const std::unique_ptr<FieldSlabs>& fields : CopiesOf(scene, bands, occupancy))
    {
      for (int round = 0; round < 3; ++round)
      {
        EXPECT_EQ(WrongValues(scene, scene.fields[0], *fields, true), 0) << eyeX << ", " << round;
        EXPECT_EQ(WrongValues(scene, scene.fields[1], *fields, round > 0), 0)
          << eyeX << ", " << round;
      }
    }
  }
}

TEST(FieldSlabs, StoreWhatWasWritten)
{
  const SlicedScene scene(-60.0);
  const FaceFrustum& frustum = scene.frusta.front();
  const BandDecomposition bands(frustum, *ThisProcess());
  const Occupancy occupancy = scene.MakeOccupancy();
  for (const std::unique_ptr<FieldSlabs>& fields : CopiesOf(scene, bands, occupancy))
  {
    std::vector<float> field = scene.fields[0];

    FieldSlabs::Windows windows{ fields->Open(field.data(), { 0, true }) };
    for (const Range<int>& slab : fields->Slabs())
    {
      fields->Load(slab, &occupancy, windows);
      for (int s = std::max(slab.begin, frustum.firstNodeSlice); s < slab.end; ++s)
      {
        const Slice& slice = frustum.SliceAt(s);
        for (int v = slice.ownedRows.begin; v < slice.ownedRows.end; ++v)
        {
          float* row = windows.front().Row(slice.node, v);
          std::for_each(row + slice.ownedColumns.begin, row + slice.ownedColumns.end,
            [](float& value) { value *= 2; });
        }
      }
      fields->Store(slab, &occupancy, windows);
    }

    for (std::size_t node = 0; node < field.size(); ++node)
    {
      ASSERT_EQ(field[node], 2 * scene.fields[0][node]) << node;
    }
  }
}

TEST(FieldSlabs, TwoWindowsDoNotShareMemory)
{
  const SlicedScene scene(-60.0);
  const BandDecomposition bands(scene.frusta.front(), *ThisProcess());
  const std::unique_ptr<FieldSlabs> fields = FieldSlabs::Local(scene.frusta.front(), bands);
  const SliceWindow first = fields->Open(nullptr, {});
  const float* released = nullptr;
  {
    const SliceWindow second = fields->Open(nullptr, {});
    EXPECT_NE(first.values, second.values);
    released = second.values;
  }
  EXPECT_EQ(fields->Open(nullptr, {}).values, released) << "is kept for the next";
}
