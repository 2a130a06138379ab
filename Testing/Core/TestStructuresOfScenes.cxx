// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What is seen of many structures in real scenes, against the independent march.

#include "LoadedScene.h"
#include "Tolerance.h"

#include "RayMarch.h"
#include "optimize/SceneStructures.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
class LabelledRealScene : public RealScene
{
};

/// Labels in blocks of the volume: of all that is important, and of many small boxes.
std::vector<StructureRow> Blocks(const LoadedScene& scene, int labels)
{
  const Int3 nodes = scene.grid.nodes;
  std::vector<StructureRow> rows;
  for (int k = 0; k < nodes.z; ++k)
  {
    for (int j = 0; j < nodes.y; ++j)
    {
      for (int i = 0; i < nodes.x; ++i)
      {
        const bool isPart =
          scene.importance[rows.size()] > 0.2f || (i / 7 + j / 9 + k / 8) % 3 == 0;
        const int block = i * 5 / nodes.x + 5 * (j * 5 / nodes.y) + 25 * (k * 5 / nodes.z);
        rows.push_back(isPart ? static_cast<StructureRow>(1 + block % labels) : StructureRow(0));
      }
    }
  }
  return rows;
}
}

TEST_P(LabelledRealScene, HasTheSharesOfTheMarch)
{
  for (const int labels : { 2, 104 })
  {
    const Tolerance bar = labels == 2
      ? Tolerance{ 0.002, "the bar of the issue" }
      : Tolerance{ 0.004, "two samples per layer of boxes with most of their matter at borders" };
    LoadedScene scene(GetParam().name);
    const std::vector<StructureRow> rows = Blocks(scene, labels);
    std::vector<Structure> all;
    for (int label = 1; label <= labels; ++label)
    {
      all.push_back({ label, "", label % 4 == 0 || labels == 2 ? 1.0 : 0.0, {} });
    }
    const Structures structures(all);
    std::transform(rows.begin(), rows.end(), scene.importance.begin(),
      [&structures](StructureRow row) { return static_cast<float>(structures.ImportanceOf(row)); });
    Solver solver = scene.MakeSolver();
    solver.Run();
    const std::vector<StructureShares> found = solver.SharesOf(structures, rows.data());

    std::vector<float> membership(rows.size());
    truth::Sampling sampling;
    sampling.raysPerVoxel = 4;
    for (int label = 1; label <= labels; label += labels == 2 ? 1 : 17)
    {
      SCOPED_TRACE(label);
      std::transform(rows.begin(), rows.end(), membership.begin(),
        [label](StructureRow row) { return row == label ? 1.0f : 0.0f; });
      const StructureShares& shares = found[static_cast<std::size_t>(label) - 1];
      if (!(shares.important > 0))
      {
        EXPECT_EQ(shares.visible, 0);
        continue;
      }
      const truth::Volume<float> volume{ scene.file.lattice, solver.Extinction().data(),
        membership.data() };
      const truth::Shares expected =
        truth::SharesOf(volume, scene.extinction.data(), scene.file.Eye(), sampling);
      EXPECT_WITHIN(shares.visible, expected.visible, bar);
      EXPECT_WITHIN(shares.removed, expected.removed, bar);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Quick, LabelledRealScene, ::testing::Values(Bars{ "carotid_mra", 0, 0 }),
  [](const auto& tested) { return std::string(tested.param.name); });

INSTANTIATE_TEST_SUITE_P(Long, LabelledRealScene,
  ::testing::Values(Bars{ "skull_phantom", 0, 0 }, Bars{ "engine", 0, 0 }),
  [](const auto& tested) { return std::string(tested.param.name); });
