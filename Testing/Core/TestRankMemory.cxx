// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What memory a rank has for the fields of a scene that it shares, counted in whole pages: little
// more than its share of what one process has.

#include "BoxScene.h"
#include "HeldByRanks.h"

#include "optimize/PreparedScene.h"

#include <gtest/gtest.h>

#include <cstdio>

using namespace limpid;

namespace
{
struct Case
{
  const char* name;
  Vec3 camera; ///< from the centre [radii]
  Vec3 light;  ///< the way it goes
};

void PrintTo(const Case& some, std::ostream* out)
{
  *out << some.name;
}

class MemoryOfRanks : public ::testing::TestWithParam<Case>
{
protected:
  MemoryOfRanks()
    : Scene(BoxScene::Cube(96))
  {
    this->Scene.FillOnion();
    const Vec3 centre = this->Scene.grid.Centre();
    this->Scene.camera.position = centre + this->Scene.grid.Radius() * GetParam().camera;
    this->Scene.light.type = LightType::Directional;
    this->Scene.light.focalPoint = centre;
    this->Scene.light.position = centre - GetParam().light;
  }

  BoxScene Scene;
};
}

TEST_P(MemoryOfRanks, IsLittleMoreThanTheirShareOfWhatOneHas)
{
  PreparedScene prepared(this->Scene.Fields());
  const ProblemInOrder scene(
    prepared.ProblemFor(this->Scene.camera, this->Scene.light, this->Scene.settings));
  for (const int ranks : { 2, 4, 8 })
  {
    const Index held = MostNodesHeld(scene, ranks);
    // One process has five results and the extinctions, importances and node importances that it
    // was given or made; while it iterates, these, two iterates and a derivative. Ranks have pieces
    // of the former three besides, for their results.
    constexpr Index ofOne = 9;
    constexpr Index inPieces = 3;
    constexpr Index whileIterating = 6;
    const double share = double(scene.problem.grid.NodeCount()) / ranks;
    EXPECT_LE(
      double(inPieces) * share + double(whileIterating * held), 1.3 * double(ofOne) * share);
    std::printf("%d ranks: a field takes %.0f bytes, a share is %.0f\n", ranks,
      double(held) * sizeof(float), share * sizeof(float));
  }
}

INSTANTIATE_TEST_SUITE_P(Ranks, MemoryOfRanks,
  ::testing::Values(Case{ "AlongX", Vec3(3, 0, 0), Vec3(0, 1, 0) },
    Case{ "AlongZ", Vec3(0, 0, 3), Vec3(1, 0, 0) },
    Case{ "AlongTheDiagonal", Vec3(2, 2, 2), Vec3(1, -2, 0.5) },
    Case{ "FromInside", Vec3(0.1, 0.2, 0.3), Vec3(1, -2, 0.5) },
    Case{ "LitFromTheCamera", Vec3(3, 1, 2), Vec3(-3, -1, -2) }),
  [](const auto& tested) { return tested.param.name; });
