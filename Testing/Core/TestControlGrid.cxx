// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The change is found on a grid that is coarser than the data, as a user chooses or as memory
// allows, and applied to the data.

#include "BoxScene.h"
#include "SceneInBoxes.h"
#include "SceneOnRanks.h"

#include "backend/PhysicalMemory.h"
#include "optimize/CoarseFields.h"
#include "optimize/CoarseScene.h"
#include "optimize/ControlledScene.h"
#include "optimize/SceneStructures.h"
#include "scene/Resampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

using namespace limpid;

namespace
{
constexpr double megabyte = 1e6;

BoxScene Onion()
{
  BoxScene scene(Int3(22, 18, 27), Vec3(1, 2, 3), Vec3(0.1, 0.12, 0.09));
  scene.FillOnion();
  return scene;
}

ControlGrid Chosen(
  const Grid& grid, ControlResolution resolution, double limit, const NeedPerNode& need = { 4, 36 })
{
  Settings settings;
  settings.controlResolution = resolution;
  settings.memoryLimit = limit;
  return ChooseControlGrid(settings, grid, *ScenePiece::Whole(grid), need);
}

/// Finds the change at half resolution and measures it on the data.
Found AtHalf(const SceneFields& fields, const Whole& scene)
{
  const ControlledScene controlled(fields, Coarser(2), scene.settings.importanceSmoothing);
  Solver solver(controlled.Fields(), scene.camera, scene.light, scene.settings);
  solver.Run();
  return FoundBy(*controlled.OnData(solver, {}));
}
}

TEST(AvailableMemory, IsSomeAndNoMoreThanThereIs)
{
  EXPECT_GT(AvailableMemory(), 0);
  EXPECT_LE(AvailableMemory(), PhysicalMemory());
}

TEST(ControlGrid, IsTheFinestThatFits)
{
  const Grid grid = BoxScene::Cube(65).grid;
  const double nodes = double(grid.NodeCount());
  const auto factorFor = [&](double bytesPerNode) {
    return Chosen(grid, ControlResolution::FinestThatFits, nodes * bytesPerNode / megabyte).factor;
  };
  EXPECT_EQ(factorFor(41), 1);
  EXPECT_EQ(factorFor(39), 2);
  EXPECT_EQ(factorFor(4 + 36.0 / 7), 2); // 33^3 of 65^3 nodes are one in 7.6
  EXPECT_EQ(factorFor(6), 3);
  EXPECT_EQ(factorFor(4.7), 4);
  EXPECT_EQ(factorFor(1), 8); // nothing fits
}

TEST(ControlGrid, IsThatOfTheDataWhereThereIsMemory)
{
  const ControlGrid grid = Chosen(BoxScene::Cube(9).grid, ControlResolution::FinestThatFits, 0);
  EXPECT_EQ(grid.factor, 1);
  EXPECT_FALSE(grid.forced);
  EXPECT_EQ(grid.Text(), "full resolution");
}

TEST(ControlGrid, SaysWhatItNeedsIfMemoryDecides)
{
  const Grid grid = BoxScene::Cube(501).grid;
  const ControlGrid forced = Chosen(grid, ControlResolution::FinestThatFits, 2000, { 4, 36, 20 });
  EXPECT_TRUE(forced.forced);
  EXPECT_FALSE(forced.measuresData);
  EXPECT_EQ(forced.Text(), "half resolution: 1.1 of 2 GB");
  const ControlGrid wanted = Chosen(grid, ControlResolution::Quarter, 0);
  EXPECT_FALSE(wanted.forced);
  EXPECT_TRUE(wanted.measuresData);
  EXPECT_EQ(wanted.Text(), "quarter resolution");
}

TEST(ControlGrid, MeasuresTheDataIfThereIsRoom)
{
  const Grid grid = BoxScene::Cube(65).grid;
  const NeedPerNode need{ 4, 36, 10 };
  const auto chosen = [&](double bytesPerNode)
  {
    return Chosen(grid, ControlResolution::FinestThatFits,
      double(grid.NodeCount()) * bytesPerNode / megabyte, need);
  };
  const ControlGrid measured = chosen(19); // 4 + 36 / 7.6 + 10
  EXPECT_EQ(measured.factor, 2);
  EXPECT_TRUE(measured.measuresData);
  const ControlGrid tight = chosen(18);
  EXPECT_EQ(tight.factor, 2);
  EXPECT_FALSE(tight.measuresData);
  EXPECT_NEAR(measured.bytes - tight.bytes, 10 * double(grid.NodeCount()), 1);
}

TEST(ControlGrid, RefusesAChosenOneThatDoesNotFit)
{
  const Grid grid = BoxScene::Cube(501).grid;
  EXPECT_NO_THROW(Chosen(grid, ControlResolution::Half, 2000));
  EXPECT_NO_THROW(Chosen(grid, ControlResolution::Full, 0, { 1e6, 0 })); // the user's own risk
  try
  {
    Chosen(grid, ControlResolution::Full, 2000);
    FAIL() << "nothing was thrown";
  }
  catch (const Error& error)
  {
    const std::string message = error.what();
    EXPECT_NE(message.find("5 GB"), std::string::npos) << message;
    EXPECT_NE(message.find("2 GB"), std::string::npos) << message;
    EXPECT_NE(message.find("MemoryLimit"), std::string::npos) << message;
  }
}

TEST(ControlGrid, IsSharedLikeTheData)
{
  const Grid fine = Onion().grid;
  for (const int factor : { 2, 3, 4, 8 })
  {
    const Grid coarse = CoarseGrid(fine, factor);
    for (int axis = 0; axis < 3; ++axis)
    {
      ThreadRanks::Run(5,
        [&](const std::shared_ptr<const Communicator>& all)
        {
          const NodeBox own = Slabs(fine.nodes, axis, 5, 1, 1)(all->Rank());
          const auto piece = PieceOn(ScenePiece(all, fine, own), fine, coarse);
          Index owned = 0;
          for (const NodeBox& box : piece->boxes)
          {
            owned += box.Count();
          }
          EXPECT_EQ(owned, coarse.NodeCount()) << factor << ' ' << axis;
        });
    }
  }
}

TEST(CoarseFields, AreThoseOfAllLayersAtOnce)
{
  const BoxScene scene = Onion();
  const auto prepared = std::make_shared<PreparedScene>(scene.Fields());
  const Index perLayer = Index(scene.grid.nodes.x) * scene.grid.nodes.y;
  for (const int factor : { 2, 3, 8 })
  {
    for (const ImportanceSmoothing smoothing :
      { ImportanceSmoothing::Off, ImportanceSmoothing::Median })
    {
      const Grid grid = CoarseGrid(scene.grid, factor);
      const CoarseScene whole(prepared, smoothing, grid);
      const CoarseFields inLayers =
        MakeCoarseFields(scene.grid, grid, smoothing, BoxesOf(scene), 3 * perLayer);
      const SceneFields expected = whole.Prepared()->Arrays();
      const auto all = [&](const float* field)
      { return std::vector<float>(field, field + grid.NodeCount()); };
      ExpectSame(inLayers.baseExtinction, all(expected.baseExtinction), "extinction");
      ExpectSame(inLayers.importance, all(expected.importance), "importance");
      EXPECT_EQ(inLayers.despeckled.empty(), expected.despeckled == nullptr);
      if (expected.despeckled)
      {
        ExpectSame(inLayers.despeckled, all(expected.despeckled), "despeckled importance");
      }
    }
  }
}

TEST(ControlledScene, IsTheSceneItselfAtFullResolution)
{
  const BoxScene scene = Onion();
  const ControlledScene controlled(scene.Fields(), Coarser(1), ImportanceSmoothing::Median);
  EXPECT_FALSE(controlled.IsCoarser());
  EXPECT_EQ(controlled.Fields().baseExtinction, scene.extinction.data());
}

TEST(ControlledScene, ShowsMoreThanTheBaseAndLittleLessThanFullResolution)
{
  BoxScene scene = BoxScene::Onion(49);
  for (const Mode mode : { Mode::Joint, Mode::Separate })
  {
    scene.settings.mode = mode;
    const Whole whole(scene);
    const Found full = OptimizedAlone(whole);
    const Found half = ByOne(whole, AtHalf);
    const double base = scene.TrueScore(scene.extinction);
    const double atHalf = scene.TrueScore(half.extinction);
    EXPECT_GT(atHalf - base, 0.8 * (scene.TrueScore(full.extinction) - base));
    // Scores are those of the data, by two quadratures of second order.
    EXPECT_NEAR(half.best.visibility, atHalf, 0.01 * atHalf);
    EXPECT_EQ(half.base.visibility, full.base.visibility);
    EXPECT_LE(half.best.visibility, half.ceiling.visibility);
    EXPECT_EQ(half.lightExtinction.empty(), mode == Mode::Joint);
  }
}

TEST(ControlledScene, InLayersHasTheSameBits)
{
  BoxScene scene = Onion();
  for (const auto& [smoothing, mode, protect, emphasis] :
    { std::tuple(ImportanceSmoothing::Off, Mode::Joint, 0.5, 0.0),
      std::tuple(ImportanceSmoothing::Median, Mode::Joint, 0.0, 1.0),
      std::tuple(ImportanceSmoothing::Median, Mode::Separate, 0.7, 0.3) })
  {
    scene.settings.importanceSmoothing = smoothing;
    scene.settings.mode = mode;
    scene.settings.protectImportance = protect;
    scene.settings.emphasis = emphasis;
    const ControlledScene whole(scene.Fields(), Coarser(2), smoothing);
    SceneFields data;
    data.grid = scene.grid;
    data.majorant = scene.Fields().majorant;
    const ControlledScene inLayers(data, BoxesOf(scene), Coarser(2), smoothing);
    EXPECT_TRUE(inLayers.IsCoarser() && inLayers.IsInLayers() && !inLayers.MeasuresData());
    EXPECT_FALSE(whole.IsInLayers());
    EXPECT_EQ(inLayers.Fields().majorant, whole.Fields().majorant);

    const bool separate = mode == Mode::Separate;
    const auto filled = [&](const ControlledScene& controlled)
    {
      Solver solver(controlled.Fields(), scene.camera, scene.light, scene.settings);
      solver.Run();
      std::vector<float> both(scene.extinction.size() * (separate ? 2 : 1));
      controlled.FillExtinction(
        solver, both.data(), separate ? both.data() + scene.extinction.size() : nullptr);
      return both;
    };
    const std::vector<float> expected = filled(whole);
    ExpectSame(filled(inLayers), expected, "extinction");
    EXPECT_NE(
      std::vector<float>(expected.begin(), expected.begin() + Index(scene.extinction.size())),
      scene.extinction);
  }
}

TEST(ControlledScene, InLayersRefusesAnExtinctionThatTheEnergyDoesNotAllow)
{
  BoxScene scene = Onion();
  scene.extinction[7] = 3.2e38f;
  SceneFields data;
  data.grid = scene.grid;
  EXPECT_THROW(ControlledScene(data, BoxesOf(scene), Coarser(2), ImportanceSmoothing::Off), Error);
}

TEST(ControlledScene, KeepsTheBoundsOfTheData)
{
  BoxScene scene = Onion();
  scene.settings.emphasis = 0;
  scene.settings.protectImportance = 0.5;
  const Found half = ByOne(Whole(scene), AtHalf);
  for (std::size_t node = 0; node < scene.extinction.size(); ++node)
  {
    EXPECT_LE(half.extinction[node], scene.extinction[node]);
    EXPECT_GE(
      half.extinction[node], 0.5f * scene.importance[node] * scene.extinction[node] * (1 - 1e-6f));
  }
}

TEST(ControlledScene, HasTheSameBitsOnAnyNumberOfRanks)
{
  BoxScene scene = Onion();
  for (const ImportanceSmoothing smoothing :
    { ImportanceSmoothing::Off, ImportanceSmoothing::Median })
  {
    scene.settings.importanceSmoothing = smoothing;
    const Whole whole(scene);
    const Found alone = ByOne(whole, AtHalf);
    for (const int ranks : { 2, 3 })
    {
      ExpectSame(By(ranks, whole, Slabs(scene.grid.nodes, 2, ranks, 0, 1), AtHalf), alone);
    }
  }
}

TEST(ControlledScene, StartsFromAnExtinctionOfTheData)
{
  const BoxScene scene = Onion();
  const ControlledScene controlled(scene.Fields(), Coarser(2), ImportanceSmoothing::Off);
  Settings settings = scene.settings;
  settings.maximumIterations = 0;
  Solver solver(controlled.Fields(), scene.camera, scene.light, settings);
  const std::vector<float> clear(scene.extinction.size(), 0.0f);
  controlled.Start(solver, clear.data());
  solver.Run();
  EXPECT_EQ(*std::max_element(solver.Extinction().begin(), solver.Extinction().end()), 0.0f);
}

TEST(ControlledScene, HasTheRowsOfTheNearestNodes)
{
  const BoxScene scene = BoxScene::Cube(5);
  const ControlledScene controlled(scene.Fields(), Coarser(2), ImportanceSmoothing::Off);
  std::vector<StructureRow> rows(std::size_t(scene.grid.NodeCount()));
  for (std::size_t node = 0; node < rows.size(); ++node)
  {
    rows[node] = static_cast<StructureRow>(node);
  }
  const std::vector<StructureRow> there = controlled.Rows(rows.data());
  ASSERT_EQ(there.size(), 27U);
  EXPECT_EQ(there.front(), 0);
  EXPECT_EQ(there[1], 2);
  EXPECT_EQ(there[3], 10);
  EXPECT_EQ(there[9], 50);
  EXPECT_EQ(there.back(), 124);
}
