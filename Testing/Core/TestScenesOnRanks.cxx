// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Real scenes shared by ranks: the same bits as on one.

#include "LoadedScene.h"
#include "SceneOnRanks.h"

#include <string>

using namespace limpid;

namespace
{
class RealSharedScene : public RealScene
{
};
}

TEST_P(RealSharedScene, HasTheSameBitsOnAnyNumberOfRanks)
{
  Whole scene{ LoadedScene(GetParam().name) };
  const Found alone = OptimizedAlone(scene);
  for (const int ranks : { 2, 4 })
  {
    SCOPED_TRACE(ranks);
    scene.places = ranks == 2 ? FieldPlaces::BesideFirstRays : FieldPlaces::BesideAllRays;
    ExpectSame(alone, OptimizedBy(ranks, scene, Slabs(scene.grid.nodes, 2, ranks, 0, 1)));
  }
}

TEST_P(RealSharedScene, HasTheSameBitsWithAdam)
{
  Whole scene{ LoadedScene(GetParam().name) };
  scene.settings.solver = SolverKind::Adam;
  scene.settings.iterationsPerLevel = { { 2, 2, 3 } };
  ExpectSame(OptimizedAlone(scene), OptimizedBy(3, scene, Slabs(scene.grid.nodes, 1, 3)));
}

INSTANTIATE_TEST_SUITE_P(Ranks, RealSharedScene,
  ::testing::Values(Bars{ "carotid_mra", 0, 0 }, Bars{ "isabel_wind", 0, 0 },
    Bars{ "vortex_rings", 0, 0 }, Bars{ "skull_phantom", 0, 0 }),
  [](const auto& tested) { return std::string(tested.param.name); });

INSTANTIATE_TEST_SUITE_P(Long, RealSharedScene,
  ::testing::Values(
    Bars{ "engine", 0, 0 }, Bars{ "visible_male", 0, 0 }, Bars{ "thorax_ct", 0, 0 }),
  [](const auto& tested) { return std::string(tested.param.name); });
