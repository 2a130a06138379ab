// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What ranks see of structures, and how they meet targets, has the bits of one rank.

#include "BoxScene.h"
#include "SceneOnRanks.h"

#include "viewpoint/MeetTargets.h"

#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

using namespace limpid;

namespace
{
/// The onion in octants, two of which have no structure.
struct Octants
{
  BoxScene onion = BoxScene::Onion();
  Structures structures;
  std::vector<float> rows; ///< numbers of rows

  /// `a`, `d`: targets of two of the structures.
  Octants(const std::optional<double>& a, const std::optional<double>& d)
    : structures(
        { { 3, "a", 0.1, a }, { 17, "b", 0.5, {} }, { 1034, "c", 0, {} }, { 65535, "d", 1, d } })
    , rows(onion.extinction.size())
  {
    onion.ForEachNode(
      [&](std::size_t node, int i, int j, int k)
      {
        constexpr StructureRow of[8] = { 1, 2, 0, 3, 4, 1, 0, 2 };
        const Vec3 x = onion.grid.PointToWorld(Vec3(i, j, k));
        const StructureRow row = of[(x.x > 0 ? 1 : 0) + (x.y > 0.1 ? 2 : 0) + (x.z > -0.1 ? 4 : 0)];
        rows[node] = row;
        onion.importance[node] = static_cast<float>(structures.ImportanceOf(row));
      });
  }

  /// What is found with the fields of all nodes or of a rank's.
  TargetsFound Meet(const SceneFields& given, const Whole& scene) const
  {
    const NodeBox box = given.piece ? given.piece->nodes : NodeBox::Of(scene.grid.nodes);
    const std::vector<float> numbers = Cut(this->rows, scene.grid.nodes, box);
    const std::vector<StructureRow> here(numbers.begin(), numbers.end());
    std::vector<float> importance = Cut(scene.importance, scene.grid.nodes, box);
    SceneFields fields = given;
    fields.importance = importance.data();
    auto solver = std::make_unique<Solver>(fields, scene.camera, scene.light, scene.settings);
    solver->Run();
    return MeetTargets(
      { fields, importance.data(), this->structures, here.data() }, {}, {}, solver);
  }

  TargetsFound MeetAlone(const Whole& scene) const
  {
    return this->Meet({ scene.grid, scene.extinction.data(), scene.importance.data() }, scene);
  }
};

void ExpectSame(const TargetsFound& one, const TargetsFound& other)
{
  EXPECT_EQ(one.runs, other.runs);
  EXPECT_EQ(one.text, other.text);
  EXPECT_EQ(one.warning, other.warning);
  ASSERT_EQ(one.shares.size(), other.shares.size());
  for (std::size_t i = 0; i < one.shares.size(); ++i)
  {
    SCOPED_TRACE(i);
    const auto row = static_cast<StructureRow>(i + 1);
    EXPECT_EQ(one.structures.ImportanceOf(row), other.structures.ImportanceOf(row));
    EXPECT_EQ(one.shares[i].important, other.shares[i].important);
    EXPECT_EQ(one.shares[i].visible, other.shares[i].visible);
    EXPECT_EQ(one.shares[i].baseVisible, other.shares[i].baseVisible);
    EXPECT_EQ(one.shares[i].removed, other.shares[i].removed);
    EXPECT_EQ(one.shares[i].attainable, other.shares[i].attainable);
    EXPECT_EQ(one.shares[i].hiddenBy, other.shares[i].hiddenBy);
  }
}

/// Compares what ranks find with what one has found.
void ExpectSameBy(int ranks, const Pieces& pieces, const Octants& octants, const Whole& scene,
  const TargetsFound& alone)
{
  std::mutex access;
  OnRanks(ranks, scene, pieces,
    [&](const SceneFields& fields, const NodeBox&)
    {
      const TargetsFound found = octants.Meet(fields, scene);
      const std::lock_guard<std::mutex> lock(access);
      ExpectSame(alone, found);
    });
}
}

TEST(StructuresOnRanks, AreSeenAsByOne)
{
  const Octants octants({}, {});
  Whole scene(octants.onion);
  scene.settings.protectImportance = 0.5;
  scene.settings.maximumIterations = 1;
  const TargetsFound alone = octants.MeetAlone(scene);
  for (const int ranks : { 1, 2, 4, 7 })
  {
    SCOPED_TRACE(ranks);
    const int empty = ranks == 7 ? 2 : 0;
    ExpectSameBy(ranks, Slabs(scene.grid.nodes, ranks % 3, ranks, empty, 1), octants, scene, alone);
  }
}

TEST(TargetsOnRanks, AreMetAsByOne)
{
  const Octants octants(0.3, 0.99);
  Whole scene(octants.onion);
  scene.settings.maximumIterations = 1;
  const TargetsFound alone = octants.MeetAlone(scene);
  EXPECT_GT(alone.runs, 1);
  EXPECT_NE(alone.warning, ""); // of the target above its ceiling
  ExpectSameBy(2, Slabs(scene.grid.nodes, 2, 2), octants, scene, alone);
}
