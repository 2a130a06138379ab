// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What sweeps from the back leave behind beside extinction and derivative, against a forward sweep.

#include "BoxScene.h"
#include "Tolerance.h"

#include "optimize/PolicySweep.h"
#include "optimize/PreparedScene.h"
#include "optimize/Terms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
struct View
{
  const char* name;
  std::function<void(BoxScene&)> change;
};

std::ostream& operator<<(std::ostream& stream, const View& view)
{
  return stream << view.name;
}

/// A filled box, importance up to its faces: nothing is zero where rays enter and leave.
BoxScene FilledScene(const View& view)
{
  BoxScene scene({ 29, 24, 33 }, { 3, -2, 5 }, { 1.0, 1.3, 0.8 });
  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      scene.extinction[node] = 0.02f + 0.05f * static_cast<float>((3 * i + 5 * j + 7 * k) % 11);
      scene.importance[node] = 0.1f * static_cast<float>((2 * i + j + 3 * k) % 9);
    });
  view.change(scene);
  return scene;
}

/// Sums of about a hundred layers in float, in another order.
Tolerance Reordered(double value)
{
  return Roundoff<float>(100, value);
}

void ExpectSame(const Visible& found, const Visible& expected)
{
  EXPECT_WITHIN(found.visible, expected.visible, Reordered(expected.visible));
  EXPECT_WITHIN(found.unattenuated, expected.unattenuated, Reordered(expected.unattenuated));
}
}

class SweepFromTheBack : public ::testing::TestWithParam<View>
{
};

TEST_P(SweepFromTheBack, LeavesScoreAndDepthsOfTheNextIterate)
{
  BoxScene scene = FilledScene(GetParam());
  PreparedScene prepared(scene.Fields());
  const Problem problem = prepared.ProblemFor(scene.camera, scene.light, scene.settings);
  Terms<HostDevice> terms(HostDevice::Shared(), problem);
  Terms<HostDevice> others(HostDevice::Shared(), problem);
  std::vector<float> next = scene.extinction;
  std::vector<FrustumRays<HostDevice>>& frusta = terms.all.front().Frusta();
  std::vector<FrustumRays<HostDevice>>& otherFrusta = others.all.front().Frusta();
  ExactDifferences moved;

  SweepPolicy(*HostDevice::Shared(), terms.all.front(), terms, problem,
    { scene.extinction.data(), nullptr, next.data(), problem.settings.weights.view, terms.Pulls(),
      Transmittance::AssumeOne, Kept::Counted },
    moved);

  Seen met;
  Seen truth;
  terms.all.front().Sum(&met, Kept::Counted);
  others.all.front().Forward(
    { next.data(), problem.importance, problem.nodeImportance, problem.baseExtinction }, &truth);
  EXPECT_LT(truth.kept.visible, truth.all.visible);
  ExpectSame(met.all, truth.all);
  ExpectSame(met.kept, truth.kept);
  int known = 0;
  for (std::size_t index = 0; index < frusta.size(); ++index)
  {
    known += MetNextIterate(index, frusta.size(), problem.settings.derivative) ? 1 : 0;
    const double* depths = otherFrusta[index].States()[RayDepth::ToSlice];
    const double* collected = frusta[index].States()[RayDepth::ToSlice];
    const Index rays = frusta[index].Plan().RayCount();
    const double deepest = *std::max_element(depths, depths + rays);
    for (Index ray = 0; ray < rays; ++ray)
    {
      ASSERT_WITHIN(collected[ray], depths[ray], Roundoff<double>(300, deepest)) << ray;
    }
  }
  EXPECT_EQ(known, 1) << "the largest frustum, which comes last";
  double squares = 0;
  double changes = 0;
  for (std::size_t node = 0; node < next.size(); ++node)
  {
    const double difference = double(next[node]) - double(scene.extinction[node]);
    squares += difference * difference;
    changes += std::abs(difference);
  }
  EXPECT_WITHIN(moved.Values().squares[0], squares, Roundoff<double>(1e5, squares));
  EXPECT_WITHIN(moved.Values().changes, changes, Roundoff<double>(1e5, changes));
}

TEST_P(SweepFromTheBack, FindsTheScoreAlongWithTheDerivative)
{
  BoxScene scene = FilledScene(GetParam());
  PreparedScene prepared(scene.Fields());
  for (const Derivative derivative : { Derivative::Volume, Derivative::Ray })
  {
    const Problem problem = prepared.ProblemFor(scene.camera, scene.light, scene.settings);
    Terms<HostDevice> terms(HostDevice::Shared(), problem);
    std::vector<float> base = scene.extinction; // thinner than what is swept, and thicker
    for (std::size_t node = 0; node < base.size(); ++node)
    {
      base[node] *= static_cast<float>(node % 5) / 2;
    }
    const TermFields fields{ scene.extinction.data(), problem.importance, problem.nodeImportance,
      base.data() };
    Seen truth;
    terms.all.front().Forward(fields, &truth);
    EXPECT_LT(truth.kept.visible, 0.9 * truth.all.visible);
    std::vector<float> added(scene.extinction.size(), 1.0f);
    std::vector<float> set(scene.extinction.size(), 0.0f);

    Seen seen;
    Seen again;
    terms.all.front().Differentiate(fields, derivative, { 1.0f, 2.0f }, added.data(), &seen);
    terms.all.front().Differentiate(fields, derivative, { 0.0f, 1.0f }, set.data(), &again);

    ExpectSame(seen.all, truth.all);
    ExpectSame(seen.kept, truth.kept);
    EXPECT_EQ(again.all.visible, seen.all.visible);
    for (std::size_t node = 0; node < set.size(); ++node)
    {
      ASSERT_WITHIN(added[node], 1 + 2 * double(set[node]),
        Roundoff<float>(4, 1 + 2 * std::abs(double(set[node]))));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Views, SweepFromTheBack,
  ::testing::Values(View{ "Outside", [](BoxScene&) {} },
    View{ "Oblique",
      [](BoxScene& scene) {
        scene.camera.position = scene.grid.Centre() + scene.grid.Radius() * Vec3(1.1, -1.2, 1.3);
      } },
    View{ "Inside",
      [](BoxScene& scene) { scene.camera.position = scene.grid.Centre() + Vec3(2, 1, -3); } },
    View{ "OnAFace",
      [](BoxScene& scene)
      { scene.camera.position = scene.grid.PointToWorld(Vec3(0, 11.3, 15.1)); } },
    View{ "AlongX",
      [](BoxScene& scene)
      { scene.camera.position = scene.grid.Centre() + scene.grid.Radius() * Vec3(-3, 0.2, 0.1); } },
    View{ "Parallel", [](BoxScene& scene) { scene.camera.parallel = true; } },
    View{ "InView",
      [](BoxScene& scene)
      {
        scene.settings.restrictToView = true;
        scene.camera.viewAngle = 12;
      } },
    View{ "WithoutSkips", [](BoxScene& scene) { scene.settings.skipUnneeded = false; } }),
  ::testing::PrintToStringParamName());
