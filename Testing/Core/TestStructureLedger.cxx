// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What is seen of each structure, removed, hidden, and by whom: against the independent march,
// closed forms, and the score of all structures together.

#include "BoxScene.h"
#include "Tolerance.h"

#include "CeilingMarch.h"
#include "backend/Backend.h"
#include "optimize/SceneStructures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
/// A scene whose importance is that of its structures.
struct LabelledScene
{
  BoxScene scene;
  Structures structures;
  std::vector<StructureRow> rows;

  template <class RowAt>
  LabelledScene(const BoxScene& given, std::vector<Structure> all, const RowAt& rowAt)
    : scene(given)
    , structures(std::move(all))
    , rows(given.extinction.size())
  {
    scene.ForEachNode(
      [&](std::size_t node, int i, int j, int k)
      {
        rows[node] = rowAt(scene.grid.PointToWorld(Vec3(i, j, k)));
        scene.importance[node] = static_cast<float>(structures.ImportanceOf(rows[node]));
      });
  }

  std::vector<StructureShares> Shares(const std::vector<float>& extinction) const
  {
    PreparedScene prepared(scene.Fields());
    return SharesOfStructures(prepared, scene.camera, scene.light, scene.settings, structures,
      rows.data(), extinction.data());
  }

  /// The scene with the importance of one structure only.
  BoxScene Only(StructureRow row) const
  {
    BoxScene only = scene;
    std::transform(rows.begin(), rows.end(), only.importance.begin(),
      [row](StructureRow here) { return here == row ? 1.0f : 0.0f; });
    return only;
  }
};

/// The onion in octants, two of which have no structure; one structure has two of them.
LabelledScene Octants(double opticalDepth)
{
  BoxScene onion = BoxScene::Cube(25);
  onion.FillOnion(opticalDepth);
  return { onion,
    { { 3, "a", 1, {} }, { 17, "b", 0.5, {} }, { 1034, "c", 0, {} }, { 65535, "d", 0.25, {} },
      { 9, "nowhere", 1, {} } },
    [](const Vec3& x)
    {
      constexpr StructureRow of[8] = { 1, 2, 0, 3, 4, 1, 0, 2 };
      return of[(x.x > 0 ? 1 : 0) + (x.y > 0.1 ? 2 : 0) + (x.z > -0.1 ? 4 : 0)];
    } };
}

std::vector<float> Optimised(const LabelledScene& labelled)
{
  Solver solver = labelled.scene.MakeSolver();
  solver.Run();
  return solver.Extinction();
}

double HiddenOf(const StructureShares& shares)
{
  return std::accumulate(shares.hiddenBy.begin(), shares.hiddenBy.end(), 0.0);
}

/// Layers across z: rows in order of increasing z, which is away from the camera, with extinctions;
/// `ends`: where they end, in [-1, 1].
LabelledScene Layers(const std::vector<StructureRow>& rows, const std::vector<double>& extinctions,
  const std::vector<double>& ends)
{
  // Between two layers is a cell in which extinction and membership change: few cells of many.
  BoxScene scene(Int3(9, 9, 641), Vec3(-1), Vec3(0.25, 0.25, 1.0 / 320));
  const auto layerAt = [=](const Vec3& x)
  {
    std::size_t layer = 0;
    while (layer + 1 < ends.size() && x.z > ends[layer])
    {
      ++layer;
    }
    return layer;
  };
  scene.Fill([=](const Vec3& x) { return extinctions[layerAt(x)]; }, [](const Vec3&) { return 0; });
  scene.camera.parallel = true;
  scene.camera.parallelScale = 2;
  scene.camera.position = scene.grid.Centre() - Vec3(0, 0, 3);
  return { scene, { { 1, "one", 1, {} }, { 2, "two", 1, {} } },
    [=](const Vec3& x) { return rows[layerAt(x)]; } };
}
}

class Ledger : public ::testing::TestWithParam<double>
{
};

TEST_P(Ledger, AgreesWithTheMarch)
{
  const LabelledScene labelled = Octants(GetParam());
  const std::vector<float> extinction = Optimised(labelled);
  const std::vector<StructureShares> found = labelled.Shares(extinction);
  truth::Sampling sampling;
  sampling.raysPerVoxel = 4;
  const Tolerance bar{ 0.002, "the bar of the issue" };
  ASSERT_EQ(found.size(), 5u);
  for (StructureRow row = 1; row <= 4; ++row)
  {
    SCOPED_TRACE(row);
    const BoxScene only = labelled.Only(row);
    const StructureShares& shares = found[row - std::size_t(1)];
    const truth::Shares expected =
      truth::SharesOf(only.TruthWith(extinction), only.extinction.data(), only.Eye(), sampling);
    const truth::Shares base = truth::SharesOf(
      only.TruthWith(only.extinction), only.extinction.data(), only.Eye(), sampling);

    EXPECT_WITHIN(shares.visible, expected.visible, bar);
    EXPECT_WITHIN(shares.baseVisible, base.visible, bar);
    EXPECT_WITHIN(shares.removed, expected.removed, bar);
    EXPECT_WITHIN(
      HiddenOf(shares), 1 - expected.visible - expected.removed, Relative(0.004, 1, "both bars"));
  }
  EXPECT_EQ(found[4].important, 0);
  EXPECT_EQ(found[4].visible, 0);
}

TEST_P(Ledger, HasTheCeilingsOfTheMarch)
{
  LabelledScene labelled = Octants(GetParam());
  for (const double protection : { 0.0, 0.7 })
  {
    labelled.scene.settings.protectImportance = protection;
    const std::vector<StructureShares> found = labelled.Shares(labelled.scene.extinction);
    truth::Sampling sampling;
    sampling.raysPerVoxel = 4;
    for (StructureRow row = 1; row <= 4; ++row)
    {
      SCOPED_TRACE(row);
      const BoxScene only = labelled.Only(row);
      std::vector<float> least(only.extinction);
      for (std::size_t node = 0; node < least.size(); ++node)
      {
        const bool isPart = labelled.rows[node] == row;
        least[node] *=
          isPart ? static_cast<float>(protection) * labelled.scene.importance[node] : 0.0f;
      }
      truth::BoundedVolume volume;
      volume.lattice = only.Lattice();
      volume.importance = only.importance.data();
      volume.least = least.data();
      volume.most = only.extinction.data();
      const double most = truth::CeilingOf(volume, only.Eye(), sampling);
      const double all = truth::ImportantExtinction(only.TruthWith(only.extinction));

      const StructureShares& shares = found[row - std::size_t(1)];
      EXPECT_WITHIN(shares.attainable, most / all, Relative(0.002, 1, "the bar of the issue"));
      EXPECT_LE(shares.baseVisible, shares.attainable + 1e-6);
    }
  }
}

// The score of all structures is the mean of their shares, weighted by importance.
TEST_P(Ledger, AddsUpToTheScore)
{
  const LabelledScene labelled = Octants(GetParam());
  Solver solver = labelled.scene.MakeSolver();
  solver.Run();
  const std::vector<StructureShares> found = labelled.Shares(solver.Extinction());
  double visible = 0;
  double removed = 0;
  double hidden = 0;
  double important = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const double weight =
      labelled.structures.ImportanceOf(static_cast<StructureRow>(i + 1)) * found[i].important;
    important += weight;
    visible += weight * found[i].visible;
    removed += weight * found[i].removed;
    hidden += weight * HiddenOf(found[i]);
  }
  const Score score = solver.BestScore();
  const Tolerance rounding = Roundoff<float>(200, 1); // sums of float along rays of 50 samples

  EXPECT_WITHIN(important, score.important, Relative(1e-5, important, "rounding"));
  EXPECT_WITHIN(visible / important, score.fraction, rounding);
  EXPECT_WITHIN(removed / important, score.sacrificed, rounding);
  EXPECT_WITHIN(hidden / important, 1 - score.fraction - score.sacrificed, rounding);
}

TEST_P(Ledger, DoesNotDependOnThreads)
{
  const LabelledScene labelled = Octants(GetParam());
  const std::vector<StructureShares> many = labelled.Shares(labelled.scene.extinction);
  const ThreadLimit one(1);
  const std::vector<StructureShares> alone = labelled.Shares(labelled.scene.extinction);
  for (std::size_t i = 0; i < many.size(); ++i)
  {
    EXPECT_EQ(many[i].visible, alone[i].visible);
    EXPECT_EQ(many[i].removed, alone[i].removed);
    EXPECT_EQ(many[i].attainable, alone[i].attainable);
    EXPECT_EQ(many[i].hiddenBy, alone[i].hiddenBy);
  }
}

INSTANTIATE_TEST_SUITE_P(ThinAndThick, Ledger, ::testing::Values(2.0, 20.0, 300.0));

// Two slabs with air between. What the second one loses is hidden by the first one, d1 in front,
// and by itself: integral of (1 - e^-(d1 + t)) (d1 or t) / (d1 + t) dt.
TEST(Ledger, OfTwoSlabsIsTheClosedForm)
{
  constexpr double first = 1.5;
  constexpr double second = 4;
  const LabelledScene labelled =
    Layers({ 0, 1, 0, 2, 0 }, { 0, first, 0, second, 0 }, { -0.8, -0.3, 0.1, 0.6, 1 });
  const StructureShares shares = labelled.Shares(labelled.scene.extinction)[1];
  const double ahead = first * 0.5;
  const double own = second * 0.5;
  constexpr int steps = 100000;
  double byFirst = 0;
  double byItself = 0;
  for (int step = 0; step < steps; ++step)
  {
    const double depth = own * (step + 0.5) / steps;
    const double hidden = (1 - std::exp(-(ahead + depth))) / steps;
    byFirst += hidden * ahead / (ahead + depth);
    byItself += hidden * depth / (ahead + depth);
  }
  const double visible = std::exp(-ahead) * (1 - std::exp(-own)) / own;

  EXPECT_WITHIN(shares.visible, visible, Relative(0.01, visible, "the bar of the issue"));
  EXPECT_WITHIN(shares.hiddenBy[1], byFirst, Relative(0.01, byFirst, "the bar of the issue"));
  EXPECT_WITHIN(shares.hiddenBy[2], byItself, Relative(0.01, byItself, "the bar of the issue"));
  EXPECT_WITHIN(shares.hiddenBy[0], 0, Relative(0.003, 1, "slopes at the faces, of one cell"));
}

// A layer in front that is no structure hides as "other".
TEST(Ledger, NamesOthersThatHide)
{
  const LabelledScene labelled = Layers({ 0, 1, 0 }, { 3, 0.5, 0 }, { -0.4, 0.3, 1 });
  const StructureShares shares = labelled.Shares(labelled.scene.extinction)[0];
  const double ahead = 3 * 0.6; // and 0.35 within the structure, which hides some of itself

  EXPECT_GT(shares.hiddenBy[0], (1 - std::exp(-ahead)) * ahead / (ahead + 0.35));
  EXPECT_WITHIN(shares.visible + shares.removed + HiddenOf(shares), 1, Roundoff<float>(200, 1));
}

// Nothing of label 2 is between 1 and 3, however they touch.
TEST(Ledger, HasNothingOfLabelsBetween)
{
  BoxScene scene = BoxScene::Onion();
  const LabelledScene labelled(scene, { { 1, "a", 1, {} }, { 2, "b", 1, {} }, { 3, "c", 1, {} } },
    [](const Vec3& x) { return StructureRow(x.x > 0 ? 3 : 1); });

  EXPECT_EQ(labelled.Shares(scene.extinction)[1].important, 0);
}
