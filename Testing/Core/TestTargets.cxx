// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The search for importances with which targets are met, on shares in closed form and in a small
// scene.

#include "BoxScene.h"
#include "Tolerance.h"

#include "optimize/Presets.h"
#include "optimize/SceneStructures.h"
#include "optimize/TargetSearch.h"
#include "viewpoint/MeetTargets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
/// Structures that share the light: of the k-th, the part w_k / (c + sum w) of its ceiling is
/// visible, w being its importance times the factor of the weights.
struct SharedLight
{
  std::vector<double> ceilings;
  double others = 0.5;

  std::vector<StructureShares> Of(const TargetSearch& search) const
  {
    const double factor = search.TriedSettings().weights.view / Settings().weights.view;
    std::vector<double> weights;
    for (std::size_t i = 0; i < this->ceilings.size(); ++i)
    {
      weights.push_back(factor * search.Tried().ImportanceOf(static_cast<StructureRow>(i + 1)));
    }
    const double all = std::accumulate(weights.begin(), weights.end(), this->others);
    std::vector<StructureShares> shares(this->ceilings.size());
    for (std::size_t i = 0; i < shares.size(); ++i)
    {
      shares[i].important = 1;
      shares[i].attainable = this->ceilings[i];
      shares[i].visible = this->ceilings[i] * weights[i] / all;
    }
    return shares;
  }
};

struct Found
{
  std::vector<StructureShares> shares;
  Structures structures;
  int runs;
};

/// Searches to the end.
Found RunAll(const SharedLight& light, TargetSearch& search)
{
  int runs = 1;
  std::vector<StructureShares> shares = light.Of(search);
  while (search.Next(shares))
  {
    shares = light.Of(search);
    ++runs;
  }
  return { shares, search.Tried(), runs };
}

Found Search(const SharedLight& light, const std::vector<Structure>& all)
{
  TargetSearch search(Structures(all), {});
  return RunAll(light, search);
}

/// A core behind a veil, and an opaque ball in front of it.
struct VeiledCore
{
  BoxScene scene = BoxScene::Cube(17);
  std::vector<StructureRow> rows; ///< 1: the core, 2: the ball

  VeiledCore()
  {
    Take(PresetNamed("Default"), this->scene.settings);
    this->scene.Fill(
      [this](const Vec3& x)
      {
        const bool isCore = glm::length(x - Vec3(0, 0, 0.3)) < 0.4;
        const bool isBall = glm::length(x - Vec3(0.55, 0.55, -0.7)) < 0.3;
        const bool isVeil = std::abs(x.z + 0.4) < 0.15;
        this->rows.push_back(isCore ? 1 : isBall ? 2 : 0);
        return isCore ? 4.0 : isBall ? 30.0 : isVeil ? 8.0 : 0.0;
      },
      Everywhere(0));
  }

  TargetsFound Meet(const std::optional<double>& ofCore, const std::optional<double>& ofBall)
  {
    const Structures structures({ { 1, "core", 0, ofCore }, { 2, "ball", 1, ofBall } });
    std::vector<float>& importance = this->scene.importance;
    FillImportance(structures, this->rows.data(), Index(this->rows.size()), importance.data());
    auto solver = std::make_unique<Solver>(this->scene.MakeSolver());
    solver->Run();
    return MeetTargets(
      { this->scene.Fields(), importance.data(), structures, this->rows.data() }, {}, {}, solver);
  }
};
}

TEST(TargetSearch, KeepsTheImportancesGivenIfTheyMeetTheTargets)
{
  const SharedLight light{ { 0.9, 0.9 } };
  const Found found = Search(light, { { 1, "", 0.8, 0.2 }, { 2, "", 0.4, {} } });
  EXPECT_EQ(found.runs, 1);
  EXPECT_EQ(found.structures.At(1).importance, 0.8);
  EXPECT_EQ(found.structures.At(2).importance, 0.4);
}

TEST(TargetSearch, MeetsTargetsThatLeaveEnoughLight)
{
  const SharedLight light{ { 0.9, 0.6, 0.8 } };
  const std::vector<Structure> all{ { 1, "", 0, 0.3 }, { 2, "", 1, {} }, { 3, "", 0.1, 0.45 } };
  const Found found = Search(light, all);
  EXPECT_LE(found.runs, 12);
  EXPECT_EQ(StateOf(all[0], found.shares[0]), TargetState::Met);
  EXPECT_EQ(StateOf(all[1], found.shares[1]), TargetState::None);
  EXPECT_EQ(StateOf(all[2], found.shares[2]), TargetState::Met);
}

// An importance above 1 becomes a smaller one of the others, and larger weights.
TEST(TargetSearch, LowersTheOthersWhereOneIsNotEnough)
{
  const SharedLight light{ { 0.9, 0.9 } };
  TargetSearch search(Structures({ { 1, "", 1, 0.8 }, { 2, "", 1, {} } }), {});
  RunAll(light, search);
  const Structures& found = search.Tried();
  EXPECT_EQ(found.At(1).importance, 1);
  EXPECT_LT(found.At(2).importance, 0.2);
  const Settings given;
  const Settings tried = search.TriedSettings();
  EXPECT_WITHIN(tried.weights.view * found.At(2).importance, given.weights.view,
    Relative(1e-12, given.weights.view, "rounding"));
  EXPECT_EQ(tried.weights.regularization, given.weights.regularization);
}

TEST(TargetSearch, DoesNotAimAboveACeiling)
{
  const SharedLight light{ { 0.5, 0.9 } };
  const std::vector<Structure> all{ { 1, "", 0.5, 0.6 }, { 2, "", 0.1, 0.4 } };
  const Found found = Search(light, all);
  EXPECT_EQ(StateOf(all[0], found.shares[0]), TargetState::Refused);
  EXPECT_EQ(StateOf(all[1], found.shares[1]), TargetState::Met);
  EXPECT_EQ(found.structures.At(1).importance, 0.5);
}

// Both could be met alone: the sum of w_k / (c + sum w) is below 1.
TEST(TargetSearch, MissesConflictingTargetsByTheSame)
{
  const SharedLight light{ { 1, 1 }, 0.1 };
  const std::vector<Structure> all{ { 1, "", 1, 0.7 }, { 2, "", 0.2, 0.6 } };
  const Found found = Search(light, all);
  EXPECT_LE(found.runs, TargetSearch::mostRuns);
  EXPECT_EQ(StateOf(all[0], found.shares[0]), TargetState::Missed);
  EXPECT_EQ(StateOf(all[1], found.shares[1]), TargetState::Missed);
  EXPECT_WITHIN(
    found.shares[0].visible, 0.55, Relative(0.02, 1, "the search ends when gains are small"));
  EXPECT_WITHIN(
    found.shares[1].visible, 0.45, Relative(0.02, 1, "the search ends when gains are small"));
}

// Nothing hides the ball: as much is visible of it with a smaller importance, at first. That must
// not keep the search from raising the importance of the core.
TEST(TargetSearch, RaisesAStructureNextToOneFarAboveItsTarget)
{
  VeiledCore veiled;
  const std::vector<StructureShares> given = veiled.Meet({}, {}).shares;
  const TargetsFound found = veiled.Meet(0.9 * given[0].attainable, 0.1 * given[1].attainable);

  SCOPED_TRACE(found.text);
  EXPECT_LT(given[0].visible, 0.1 * given[0].attainable);
  EXPECT_GT(given[1].visible, 0.9 * given[1].attainable);
  EXPECT_EQ(found.warning, "");
  EXPECT_EQ(StateOf(found.structures.At(1), found.shares[0]), TargetState::Met);
  EXPECT_EQ(StateOf(found.structures.At(2), found.shares[1]), TargetState::Met);
}

TEST(TargetSearch, BeginsAgainWhereItEnded)
{
  const SharedLight light{ { 0.9, 0.9 } };
  TargetSearch search(Structures({ { 1, "", 0.2, 0.6 }, { 2, "", 1, {} } }), {});
  RunAll(light, search);
  TargetSearch again = search.Again({});
  EXPECT_EQ(again.Tried().At(1).importance, search.Tried().At(1).importance);
  EXPECT_EQ(again.Tried().At(2).importance, search.Tried().At(2).importance);
  std::vector<StructureShares> shares = light.Of(again);
  EXPECT_FALSE(again.Next(shares));
}

TEST(TargetSearch, TellsWhatIsMetAndWhatIsNot)
{
  const Structures structures(
    { { 1, "tumour", 1, 0.95 }, { 2, "vessels", 1, 0.6 }, { 3, "rest", 1, {} } });
  std::vector<StructureShares> shares(3);
  shares[0].important = shares[1].important = 1;
  shares[0].visible = 0.952;
  shares[0].attainable = 0.97;
  shares[1].visible = 0.58;
  shares[1].attainable = 0.61;
  EXPECT_EQ(TextOfTargets(structures, shares),
    "tumour 95.2 % (>= 95.0 %), vessels 58.0 % of at most 61.0 % (target 60.0 %)");
}
