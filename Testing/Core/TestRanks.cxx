// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Scenes shared by ranks: the same bits as on one, however many ranks there are and whatever pieces
// they have at first; what goes wrong on one goes wrong on all.

#include "OneOf.h"
#include "RandomScene.h"
#include "SceneOnRanks.h"

#include "Resampled.h"
#include "backend/Interruption.h"
#include "scene/Resampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>
#include <mutex>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
BoxScene Onion()
{
  BoxScene scene(Int3(22, 18, 26), Vec3(1, 2, 3), Vec3(0.1, 0.12, 0.09));
  scene.FillOnion();
  scene.settings.maximumIterations = 12;
  return scene;
}

struct Case
{
  const char* name;
  void (*arrange)(BoxScene& scene);
};

void PrintTo(const Case& some, std::ostream* out)
{
  *out << some.name;
}

class SharedScene : public ::testing::TestWithParam<Case>
{
protected:
  Whole Make() const
  {
    BoxScene scene = Onion();
    GetParam().arrange(scene);
    return Whole(scene);
  }

  /// Whether an arrangement on ranks is tried: a third of them unless all are wanted (OneOf),
  /// others for other scenes. `indices`: the sum of those of its loops.
  static bool Tries(int indices)
  {
    return (indices + static_cast<int>(std::strlen(GetParam().name))) % OneOf(3) == 0;
  }
};

void LookFrom(BoxScene& scene, const Vec3& radii)
{
  scene.camera.position = scene.grid.Centre() + scene.grid.Radius() * radii;
}

void LookFromNode(BoxScene& scene, const Vec3& index)
{
  scene.camera.position = scene.grid.PointToWorld(index);
}

void UseAdam(BoxScene& scene)
{
  scene.settings.solver = SolverKind::Adam;
  scene.settings.iterationsPerLevel = { { 4, 3, 5 } };
}

/// The message that all ranks get.
std::string MessageOf(const std::function<void()>& work)
{
  try
  {
    work();
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
  return {};
}

/// Messages of ranks, which all have to fail.
class Messages
{
public:
  template <class Work>
  void Of(const Work& work)
  {
    const std::string message = MessageOf(work);
    const std::lock_guard<std::mutex> lock(this->Access);
    this->All.push_back(message);
  }

  const std::vector<std::string>& Get() const { return this->All; }

private:
  std::mutex Access;
  std::vector<std::string> All;
};
}

TEST_P(SharedScene, HasTheSameBitsOnAnyNumberOfRanks)
{
  Whole scene = this->Make();
  const Found alone = OptimizedAlone(scene);
  for (const FieldPlaces places : placesOfFields)
  {
    scene.places = places;
    int number = 0;
    for (const int ranks : { 1, 2, 3, 4, 8 })
    {
      if (Tries(int(places) + number++))
      {
        SCOPED_TRACE(::testing::Message() << ranks << " ranks, places " << int(places));
        ExpectSame(alone, OptimizedBy(ranks, scene, Slabs(scene.grid.nodes, ranks % 3, ranks)));
      }
    }
  }
}

TEST_P(SharedScene, DoesNotDependOnThePieces)
{
  const Whole scene = this->Make();
  const Found alone = OptimizedAlone(scene);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const int empty : { 0, 1 })
    {
      for (const int more : { 0, 1, 2 })
      {
        if (Tries(axis + empty + more))
        {
          SCOPED_TRACE(::testing::Message() << axis << empty << more);
          ExpectSame(alone, OptimizedBy(3, scene, Slabs(scene.grid.nodes, axis, 3, empty, more)));
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Ranks, SharedScene,
  ::testing::Values(Case{ "FromOutside", [](BoxScene&) {} },
    Case{ "FromInside", [](BoxScene& scene) { LookFromNode(scene, Vec3(7.3, 11.2, 9.6)); } },
    Case{ "OnANode", [](BoxScene& scene) { LookFromNode(scene, Vec3(7, 11, 9)); } },
    Case{ "AlongX", [](BoxScene& scene) { LookFrom(scene, Vec3(3, 0, 0)); } },
    Case{ "AlongY", [](BoxScene& scene) { LookFrom(scene, Vec3(0, 3, 0)); } },
    Case{ "AlongZ", [](BoxScene& scene) { LookFrom(scene, Vec3(0, 0, 3)); } },
    Case{ "AlongTheDiagonal", [](BoxScene& scene) { LookFrom(scene, Vec3(2, 2, 2)); } },
    Case{ "Parallel", [](BoxScene& scene) { scene.camera.parallel = true; } },
    Case{ "Separate", [](BoxScene& scene) { scene.settings.mode = Mode::Separate; } },
    Case{ "WithoutLight", [](BoxScene& scene) { scene.settings.weights.light = 0; } },
    Case{ "WithoutCamera", [](BoxScene& scene) { scene.settings.weights.view = 0; } },
    Case{ "WithoutSkips", [](BoxScene& scene) { scene.settings.skipUnneeded = false; } },
    Case{ "DespeckledImportance",
      [](BoxScene& scene) { scene.settings.importanceSmoothing = ImportanceSmoothing::Median; } },
    Case{ "Protected", [](BoxScene& scene) { scene.settings.protectImportance = 0.5; } },
    Case{ "WithoutEmphasis", [](BoxScene& scene) { scene.settings.emphasis = 0; } },
    Case{ "Threshold", [](BoxScene& scene) { scene.settings.clearingThreshold = 0.1; } },
    Case{ "SmallWeights", [](BoxScene& scene) { scene.settings.weights.view = 0.1; } },
    Case{ "AlongRays", [](BoxScene& scene) { scene.settings.derivative = Derivative::Ray; } },
    Case{ "Smooth", [](BoxScene& scene) { scene.settings.smoothness = 0.2; } },
    Case{ "Adam", [](BoxScene& scene) { UseAdam(scene); } },
    Case{ "AdamFromInside",
      [](BoxScene& scene)
      {
        UseAdam(scene);
        LookFromNode(scene, Vec3(7.3, 11.2, 9.6));
      } },
    Case{ "AdamSeparate",
      [](BoxScene& scene)
      {
        UseAdam(scene);
        scene.settings.mode = Mode::Separate;
      } },
    Case{ "AdamAlongXSmooth",
      [](BoxScene& scene)
      {
        UseAdam(scene);
        LookFrom(scene, Vec3(3, 0, 0));
        scene.settings.smoothness = 0.2;
      } },
    Case{ "AdamAlongRays",
      [](BoxScene& scene)
      {
        UseAdam(scene);
        scene.settings.derivative = Derivative::Ray;
      } },
    Case{ "PointLight", [](BoxScene& scene) { scene.light.type = LightType::Point; } },
    Case{ "SeveralCameras",
      [](BoxScene& scene)
      {
        scene.settings.otherCameras = { scene.camera };
        scene.settings.otherCameras.front().position += Vec3(4, 1, 5);
      } }),
  [](const auto& tested) { return tested.param.name; });

// Where opaque matter may be removed, steps also descend from what a coarser grid finds.
TEST(Ranks, HaveTheSameBitsInOpaqueMatter)
{
  BoxScene scene(Int3(49, 44, 42), Vec3(0.0), Vec3(1.0));
  scene.FillOnion(1000); // an optical depth of 26 from node to node
  scene.settings.maximumIterations = 2;
  const Whole whole(scene);

  const Found alone = OptimizedAlone(whole);

  for (int axis = 0; axis < 3; ++axis)
  {
    SCOPED_TRACE(axis);
    ExpectSame(alone, OptimizedBy(2, whole, Slabs(scene.grid.nodes, axis, 2)));
  }
}

TEST(Ranks, HaveTheSameBitsOnScenesAtRandom)
{
  for (unsigned seed = 0; seed < 60; ++seed)
  {
    SCOPED_TRACE(seed);
    Whole scene(MakeRandomScene(seed));
    scene.settings.maximumIterations = 4;
    scene.settings.iterationsPerLevel = { { 2, 2, 3 } };
    const Found alone = OptimizedAlone(scene);
    for (const int ranks : { 2, 5 })
    {
      SCOPED_TRACE(ranks);
      scene.places = placesOfFields[(seed + unsigned(ranks)) % 3];
      ExpectSame(alone,
        OptimizedBy(ranks, scene, Slabs(scene.grid.nodes, int(seed % 3), ranks, 0, int(seed % 2))));
    }
    if (HasFailure())
    {
      return;
    }
  }
}

namespace
{
/// An optimisation, and another one for a camera beside that stays near what the first has found,
/// and one that starts there. Where the grid of the change is another, of the optimisation there.
Found FoundAfter(const SceneFields& fields, const Whole& scene, const SceneFields& before)
{
  Solver first(before, scene.camera, scene.light, scene.settings);
  first.Run();
  Whole next = scene;
  next.camera.position += Vec3(0.1, 0.05, 0);
  Solver solver(fields, next.camera, next.light, next.settings, first.Change());
  solver.Run();
  return FoundBy(solver);
}

Found StartedFrom(const SceneFields& fields, const Whole& scene)
{
  std::vector<float> start(fields.baseExtinction, fields.baseExtinction + fields.ValueCount());
  for (float& value : start)
  {
    value *= 0.5f;
  }
  Solver solver(fields, scene.camera, scene.light, scene.settings);
  solver.SetInitialExtinction(start.data());
  solver.Run();
  return FoundBy(solver);
}
}

TEST_P(SharedScene, StartsFromAnythingWithTheSameBits)
{
  Whole scene = this->Make();
  scene.settings.mode = Mode::Joint;
  const Found alone = ByOne(scene, StartedFrom);
  for (const int ranks : { 2, 5 })
  {
    SCOPED_TRACE(ranks);
    scene.places = placesOfFields[ranks % 3];
    ExpectSame(
      alone, By(ranks, scene, Slabs(scene.grid.nodes, ranks % 3, ranks, 1, 1), StartedFrom));
  }
}

TEST_P(SharedScene, StaysNearWhatWasWithTheSameBits)
{
  Whole scene = this->Make();
  scene.settings.temporalCoherence = 0.2;
  const auto after = [](const SceneFields& fields, const Whole& of)
  { return FoundAfter(fields, of, fields); };
  const Found alone = ByOne(scene, after);
  for (const int ranks : { 2, 5 })
  {
    SCOPED_TRACE(ranks);
    scene.places = placesOfFields[(ranks + 2) % 3];
    ExpectSame(alone, By(ranks, scene, Slabs(scene.grid.nodes, ranks % 3, ranks, 1, 1), after));
  }
}

TEST(Ranks, StayNearWhatWasOnAnotherGrid)
{
  Whole scene(Onion());
  scene.settings.temporalCoherence = 0.2;
  Whole coarse = scene;
  coarse.grid = CoarseGrid(scene.grid, 2);
  coarse.extinction = Resampled(scene.grid, scene.extinction.data(), coarse.grid);
  coarse.importance = Resampled(scene.grid, scene.importance.data(), coarse.grid);
  const SceneFields small{ coarse.grid, coarse.extinction.data(), coarse.importance.data() };
  const Found alone = ByOne(scene,
    [&](const SceneFields& fields, const Whole& of) { return FoundAfter(fields, of, small); });
  for (const int ranks : { 2, 3 })
  {
    SCOPED_TRACE(ranks);
    const Pieces pieces = Slabs(scene.grid.nodes, 2, ranks, 0, 1);
    const Pieces others = Slabs(coarse.grid.nodes, 0, ranks, 0, 1);
    ExpectSame(alone,
      By(ranks, scene, pieces,
        [&](const SceneFields& fields, const Whole& of)
        {
          Found found;
          OnPiece(fields.piece->ranks, coarse, others,
            [&](const SceneFields& before, const NodeBox&)
            { found = FoundAfter(fields, of, before); });
          return found;
        }));
  }
}

TEST(Ranks, MayAllHaveTheWholeScene)
{
  const Whole scene(Onion());
  ExpectSame(OptimizedAlone(scene),
    OptimizedBy(3, scene, [&](int) { return NodeBox::Of(scene.grid.nodes); }));
}

TEST(Ranks, TakeWhatNobodyHasForEmpty)
{
  Whole scene(Onion());
  const Pieces gap = [&](int rank)
  {
    NodeBox box = NodeBox::Of(scene.grid.nodes);
    box.along[2] = rank == 0 ? Range<int>{ 0, 9 } : Range<int>{ 14, scene.grid.nodes.z };
    return box;
  };
  const Found found = OptimizedBy(2, scene, gap);
  const Index slice = Index(scene.grid.nodes.x) * scene.grid.nodes.y;
  std::fill(scene.extinction.begin() + 9 * slice, scene.extinction.begin() + 14 * slice, 0.0f);
  std::fill(scene.importance.begin() + 9 * slice, scene.importance.begin() + 14 * slice, 0.0f);
  const Found alone = OptimizedAlone(scene);
  EXPECT_EQ(alone.best.visibility, found.best.visibility);
}

TEST(Ranks, AllTellWhatIsWrongOnOne)
{
  Whole scene(Onion());
  scene.importance[scene.importance.size() - 5] = std::numeric_limits<float>::quiet_NaN();
  Messages messages;
  OnRanks(3, scene, Slabs(scene.grid.nodes, 2, 3),
    [&](const SceneFields& fields, const NodeBox&)
    { messages.Of([&] { Optimized(fields, scene); }); });
  ASSERT_EQ(messages.Get().size(), 3u);
  for (const std::string& message : messages.Get())
  {
    EXPECT_NE(message.find("Rank 2: The importance of voxel " +
                std::to_string(scene.importance.size() - 5) + " is"),
      std::string::npos)
      << message;
  }
}

TEST(Ranks, AreRefusedPiecesThatAreNone)
{
  const Whole scene(Onion());
  const auto outside = [&](int rank)
  {
    NodeBox box = Slabs(scene.grid.nodes, 0, 2)(rank);
    box.along[1].end += rank;
    return box;
  };
  const auto inACorner = [&](int rank)
  {
    NodeBox box = NodeBox::Of(scene.grid.nodes);
    box.along[0] = rank == 0 ? Range<int>{ 0, 12 } : Range<int>{ 3, 9 };
    box.along[1] = rank == 0 ? Range<int>{ 3, 9 } : Range<int>{ 0, 12 };
    return box;
  };
  const auto messageOf = [&](const Pieces& pieces)
  {
    Messages messages;
    ThreadRanks::Run(2,
      [&](const std::shared_ptr<const Communicator>& all)
      { messages.Of([&] { ScenePiece(all, scene.grid, pieces(all->Rank())); }); });
    EXPECT_EQ(messages.Get()[0], messages.Get()[1]);
    return messages.Get()[0];
  };
  EXPECT_NE(messageOf(outside).find("outside the image"), std::string::npos);
  EXPECT_NE(messageOf(inACorner).find("in a corner"), std::string::npos);
}

TEST(Ranks, AreRefusedWhatTheyCannotDoTogether)
{
  Whole scene(Onion());
  scene.settings.method = Method::Viola2004;
  Messages messages;
  OnRanks(2, scene, Slabs(scene.grid.nodes, 2, 2),
    [&](const SceneFields& fields, const NodeBox&)
    { messages.Of([&] { Optimized(fields, scene); }); });
  for (const std::string& message : messages.Get())
  {
    EXPECT_NE(message.find("the method"), std::string::npos) << message;
  }
}

TEST(Ranks, AreRefusedOtherViewsThanTheOthers)
{
  const Whole scene(Onion());
  Messages messages;
  OnRanks(3, scene, Slabs(scene.grid.nodes, 2, 3),
    [&](const SceneFields& fields, const NodeBox&)
    {
      Whole here = scene;
      here.camera.position.x += fields.piece->ranks->Rank() == 2 ? 1e-9 : 0.0;
      messages.Of([&] { Optimized(fields, here); });
    });
  for (const std::string& message : messages.Get())
  {
    EXPECT_NE(message.find("The ranks differ in the camera"), std::string::npos) << message;
  }
}

TEST(Ranks, TellHowTheWorkIsDivided)
{
  const Whole scene(Onion());
  OnRanks(3, scene, Slabs(scene.grid.nodes, 2, 3),
    [&](const SceneFields& fields, const NodeBox&)
    {
      const Solver solver(fields, scene.camera, scene.light, scene.settings);
      EXPECT_NE(solver.BackendName().find("CPU, "), std::string::npos);
      EXPECT_NE(solver.BackendName().find(", on each of 3 ranks"), std::string::npos);
    });
}

TEST(Ranks, StopTogether)
{
  const Whole scene(Onion());
  std::mutex access;
  std::vector<int> iterations;
  OnRanks(3, scene, Slabs(scene.grid.nodes, 2, 3),
    [&](const SceneFields& fields, const NodeBox&)
    {
      Solver solver(fields, scene.camera, scene.light, scene.settings);
      const bool stops = fields.piece->ranks->Rank() == 1;
      solver.Run([&](double, const std::string&) { return !stops || solver.Iterations() < 2; });
      const std::lock_guard<std::mutex> lock(access);
      iterations.push_back(solver.Iterations());
      EXPECT_TRUE(solver.Stopped());
    });
  EXPECT_EQ(iterations, std::vector<int>(3, 2));
}

TEST(Ranks, AreInterruptedTogether)
{
  const Whole scene(Onion());
  for (const int when : { 1, 3, 10, 50, 200 })
  {
    SCOPED_TRACE(when);
    std::mutex access;
    int interrupted = 0;
    OnRanks(3, scene, Slabs(scene.grid.nodes, 2, 3),
      [&](const SceneFields& fields, const NodeBox&)
      {
        int asked = 0;
        const bool stops = fields.piece->ranks->Rank() == 2;
        try
        {
          Solver solver(fields, scene.camera, scene.light, scene.settings);
          const Interruptible interruptible([&] { return !stops || ++asked < when; }, 0);
          solver.Run();
        }
        catch (const Interrupted&)
        {
          const std::lock_guard<std::mutex> lock(access);
          ++interrupted;
        }
      });
    EXPECT_EQ(interrupted, 3);
  }
}

TEST(Ranks, FailTogether)
{
  const Whole scene(Onion());
  Messages messages;
  OnRanks(3, scene, Slabs(scene.grid.nodes, 2, 3),
    [&](const SceneFields& fields, const NodeBox&)
    {
      const bool fails = fields.piece->ranks->Rank() == 1;
      messages.Of(
        [&]
        {
          Solver solver(fields, scene.camera, scene.light, scene.settings);
          solver.Run(
            [&](double, const std::string&)
            {
              if (fails)
              {
                throw std::bad_alloc();
              }
              return true;
            });
        });
    });
  ASSERT_EQ(messages.Get().size(), 3u);
  EXPECT_EQ(std::count(messages.Get().begin(), messages.Get().end(), ""), 0);
}
