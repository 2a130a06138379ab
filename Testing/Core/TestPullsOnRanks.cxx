// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "BoxScene.h"
#include "SceneOnRanks.h"

#include <algorithm>
#include <vector>

using namespace limpid;

// The reference that a caller gives is in pieces, as all other fields.
TEST(PullsOnRanks, StayNearAReference)
{
  Whole scene(BoxScene::Onion());
  scene.settings.referencePull = 0.3;
  std::vector<float> reference(scene.extinction);
  std::transform(reference.begin(), reference.end(), reference.begin(),
    [](float extinction) { return 0.5f * extinction; });
  const Find find = [&](const SceneFields& given, const Whole& of)
  {
    const NodeBox all = NodeBox::Of(of.grid.nodes);
    const std::vector<float> part =
      Cut(reference, of.grid.nodes, given.piece ? given.piece->nodes : all);
    SceneFields fields = given;
    fields.references[0] = part.data();
    return Optimized(fields, of);
  };
  const Found alone = ByOne(scene, find);
  EXPECT_GT(alone.history.back().energy.reference, 0);
  for (const int ranks : { 1, 2, 4 })
  {
    SCOPED_TRACE(ranks);
    const Found found = By(ranks, scene, Slabs(scene.grid.nodes, ranks % 3, ranks, 0, 1), find);
    ExpectSame(alone, found);
    EXPECT_EQ(alone.history.back().energy.reference, found.history.back().energy.reference);
  }
}
