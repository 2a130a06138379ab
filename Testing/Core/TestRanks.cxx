// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Scenes shared by ranks: the same bits as on one, however many ranks there are and whatever pieces
// they have at first.

#include "BoxScene.h"
#include "ThreadRanks.h"

#include "optimize/Solver.h"
#include "sweep/RankRegions.h"

#include <gtest/gtest.h>

#include <cstring>
#include <mutex>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
/// What comes of an optimisation.
struct Found
{
  std::vector<float> extinction;
  std::vector<IterationRecord> history;
  Score base;
  Score best;
};

Found Optimized(const SceneFields& fields, const BoxScene& scene)
{
  Solver solver(fields, scene.camera, scene.light, scene.settings);
  solver.Run();
  return { solver.Extinction(), solver.History(), solver.BaseScore(), solver.BestScore() };
}

/// Cuts the nodes into slabs along an axis, as many as there are ranks; `first` of them have none.
NodeBox PieceOf(const Int3& nodes, int axis, int rank, int ranks, int first = 0)
{
  NodeBox box = NodeBox::Of(nodes);
  const int parts = ranks - first;
  const int part = rank - first;
  box.along[std::size_t(axis)] = part < 0
    ? Range<int>{}
    : Range<int>{ nodes[axis] * part / parts, nodes[axis] * (part + 1) / parts };
  return box;
}

std::vector<float> Cut(const std::vector<float>& field, const Int3& nodes, const NodeBox& box)
{
  std::vector<float> values(std::size_t(box.Count()));
  CopyNodes(box, FieldView::Whole(const_cast<float*>(field.data()), nodes),
    FieldView::Part(values.data(), box));
  return values;
}

/// The optimisation by several ranks; `cut`: gives the piece of a rank.
template <class CutPiece>
Found OptimizedBy(int ranks, const BoxScene& scene, const CutPiece& cut)
{
  const Int3 nodes = scene.grid.nodes;
  Found found;
  found.extinction.resize(scene.extinction.size(), -1.0f);
  std::mutex access;
  ThreadRanks::Run(ranks,
    [&](const std::shared_ptr<const Communicator>& all)
    {
      const NodeBox box = cut(all->Rank());
      const auto piece = std::make_shared<const ScenePiece>(all, scene.grid, box);
      const std::vector<float> extinction = Cut(scene.extinction, nodes, box);
      const std::vector<float> importance = Cut(scene.importance, nodes, box);
      SceneFields fields{ scene.grid, extinction.data(), importance.data() };
      fields.piece = piece;
      Found here = Optimized(fields, scene);
      const std::lock_guard<std::mutex> lock(access);
      CopyNodes(box, FieldView::Part(here.extinction.data(), box),
        FieldView::Whole(found.extinction.data(), nodes));
      if (all->Rank() == 0)
      {
        found.history = here.history;
        found.base = here.base;
        found.best = here.best;
      }
      else
      {
        EXPECT_EQ(here.best.visibility, here.best.visibility);
      }
    });
  return found;
}

void ExpectSame(const Score& one, const Score& other)
{
  EXPECT_EQ(one.visibility, other.visibility);
  EXPECT_EQ(one.fraction, other.fraction);
  EXPECT_EQ(one.sacrificed, other.sacrificed);
}

void ExpectSame(const Found& one, const Found& other)
{
  ASSERT_EQ(one.history.size(), other.history.size());
  for (std::size_t i = 0; i < one.history.size(); ++i)
  {
    EXPECT_EQ(one.history[i].energy.Total(), other.history[i].energy.Total()) << "iteration " << i;
    EXPECT_EQ(one.history[i].meanChange, other.history[i].meanChange) << "iteration " << i;
    ExpectSame(one.history[i].score, other.history[i].score);
  }
  ExpectSame(one.base, other.base);
  ExpectSame(one.best, other.best);
  ASSERT_EQ(one.extinction.size(), other.extinction.size());
  EXPECT_EQ(0, std::memcmp(one.extinction.data(), other.extinction.data(),
                 one.extinction.size() * sizeof(float)));
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
  SharedScene()
    : Scene(Int3(22, 18, 26), Vec3(1, 2, 3), Vec3(0.1, 0.12, 0.09))
  {
    this->Scene.FillOnion();
    GetParam().arrange(this->Scene);
    this->Scene.settings.maximumIterations = 12;
    this->Alone = Optimized(this->Scene.Fields(), this->Scene);
  }

  BoxScene Scene;
  Found Alone;
};
}

TEST_P(SharedScene, HasTheSameBitsOnAnyNumberOfRanks)
{
  for (const int ranks : { 1, 2, 3, 4, 8 })
  {
    SCOPED_TRACE(ranks);
    ExpectSame(this->Alone,
      OptimizedBy(ranks, this->Scene,
        [&](int rank) { return PieceOf(this->Scene.grid.nodes, ranks % 3, rank, ranks); }));
  }
}

TEST_P(SharedScene, DoesNotDependOnThePieces)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    SCOPED_TRACE(axis);
    ExpectSame(this->Alone,
      OptimizedBy(3, this->Scene,
        [&](int rank) { return PieceOf(this->Scene.grid.nodes, axis, rank, 3, 1); }));
  }
}

INSTANTIATE_TEST_SUITE_P(Ranks, SharedScene,
  ::testing::Values(Case{ "FromOutside", [](BoxScene&) {} },
    Case{ "FromInside",
      [](BoxScene& scene) { scene.camera.position = scene.grid.PointToWorld(Vec3(7.3, 11.2, 9.6)); } },
    Case{ "OnANode",
      [](BoxScene& scene) { scene.camera.position = scene.grid.PointToWorld(Vec3(7, 11, 9)); } },
    Case{ "AlongX",
      [](BoxScene& scene)
      { scene.camera.position = scene.grid.Centre() + 3 * scene.grid.Radius() * Vec3(1, 0, 0); } },
    Case{ "AlongY",
      [](BoxScene& scene)
      { scene.camera.position = scene.grid.Centre() + 3 * scene.grid.Radius() * Vec3(0, 1, 0); } },
    Case{ "AlongZ",
      [](BoxScene& scene)
      { scene.camera.position = scene.grid.Centre() + 3 * scene.grid.Radius() * Vec3(0, 0, 1); } },
    Case{ "AlongTheDiagonal",
      [](BoxScene& scene)
      { scene.camera.position = scene.grid.Centre() + 2 * scene.grid.Radius() * Vec3(1, 1, 1); } },
    Case{ "Parallel", [](BoxScene& scene) { scene.camera.parallel = true; } },
    Case{ "Separate", [](BoxScene& scene) { scene.settings.mode = Mode::Separate; } },
    Case{ "WithoutLight", [](BoxScene& scene) { scene.settings.weights.light = 0; } },
    Case{ "WithoutSkips", [](BoxScene& scene) { scene.settings.skipUnneeded = false; } },
    Case{ "SeveralCameras",
      [](BoxScene& scene)
      {
        scene.settings.otherCameras = { scene.camera };
        scene.settings.otherCameras.front().position += Vec3(4, 1, 5);
      } }),
  [](const auto& tested) { return tested.param.name; });
