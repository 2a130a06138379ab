// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "MethodScenes.h"
#include "Tolerance.h"

#include "math/Require.h"
#include "methods/Ament2017.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace limpid;

TEST(Ament2017, KeepsTheShareOfTheClosedForm)
{
  BoxScene scene = NestedShells(64);
  scene.settings.ament.background = 7;
  scene.settings.ament.exponent = 1.5;
  const Shown shown = ShownBy(Method::Ament2017, scene);
  const double chord = (2 * coreRadius + 1.5 * scene.grid.spacing.z) / radius;
  const auto keptAt = [&](const Vec3& position)
  {
    const Vec3 index = scene.grid.PointToIndex(position) + 0.5;
    const std::size_t node =
      std::size_t(index.x) + 65 * (std::size_t(index.y) + 65 * std::size_t(index.z));
    return double(shown.extinction[node]) / double(scene.extinction[node]);
  };
  const Tolerance cell = Relative(0.01, 1, "the border of the ball is a cell wide");

  EXPECT_WITHIN(keptAt({ 0, 0, -0.7 }), 1 / (1 + 30 * chord), cell); // hides it
  EXPECT_WITHIN(keptAt({ 0, 0, 0.7 }), 1 / (1 + 7 * chord), cell);   // lies behind it
  EXPECT_EQ(keptAt({ 0, 0, 0 }), 1);                                 // is it
  EXPECT_EQ(keptAt({ 0.7, 0, 0 }), 1);                               // has nothing to do with it
}

// The march integrates squared importance, linear between nodes, in double precision: from the
// camera on in front, and from the other end of parallel rays behind.
TEST(Ament2017, AgreesWithAMarchAlongObliqueRays)
{
  BoxScene scene({ 33, 27, 30 }, { 3, -2, 5 }, { 1.0, 1.2, 1.1 });
  scene.FillOnion();
  scene.camera.parallel = true;
  scene.settings.ament.background = 7;
  scene.settings.ament.smoothingPasses = 0;
  scene.settings.ament.occluders = 30;
  scene.settings.rayDensity = 2;
  const Shown shown = ShownBy(Method::Ament2017, scene);
  std::vector<float> squares = scene.importance;
  for (float& value : squares)
  {
    value *= value;
  }
  const truth::Volume<float> volume = scene.TruthWith(squares);
  const truth::Source back =
    truth::Source::Parallel(ToTruth(scene.camera.position - scene.camera.focalPoint));
  double error = 0;
  int count = 0;

  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      if (scene.extinction[node] > 0)
      {
        const truth::Vector here = ToTruth(scene.grid.PointToWorld(Vec3(i, j, k)));
        const double size = scene.grid.Radius();
        const double load = std::pow(1 - double(scene.importance[node]), 2) *
          (7 * truth::OpticalDepth(volume, scene.Eye(), here) / size +
            30 * truth::OpticalDepth(volume, back, here) / size);
        const double share = double(shown.extinction[node]) / double(scene.extinction[node]);
        error += std::pow(share - 1 / (1 + load), 2);
        ++count;
      }
    });

  EXPECT_WITHIN(std::sqrt(error / count), 0.0,
    Relative(0.01, 1, "rays and the means over them, second order, 30 cells across"));
}

TEST(Ament2017, LetsWhatIsHalfImportantGiveWayByItsExponent)
{
  const AmentKeptShare kept{ 2 * 1.5f, 2, 30, 7 };

  const float share = kept(0.5f, 0.2f, 0.4f);

  const double load = std::pow(0.5, 3) * (7 * 0.2 + 30 * 0.4);
  EXPECT_WITHIN(share, 2 / (2 + load), Roundoff<float>(8, 1.0));
}

TEST(Ament2017, IsOrdinaryBitForBitWithoutImportance)
{
  BoxScene scene({ 17, 21, 13 }, { 3, -2, 5 }, { 1.0, 1.3, 0.8 });
  scene.FillOnion();
  scene.settings.ament.smoothingPasses = 3;
  scene.settings.ament.background = 10;
  std::fill(scene.importance.begin(), scene.importance.end(), 0.0f);

  const Shown shown = ShownBy(Method::Ament2017, scene);

  EXPECT_EQ(shown.extinction, scene.extinction);
  EXPECT_EQ(shown.lightExtinction, scene.extinction);
}

TEST(Ament2017, IsOrdinaryBitForBitWhereNothingImportantIsOnTheWay)
{
  BoxScene scene = NestedShells(32);
  scene.settings.ament.smoothingPasses = 0;
  scene.settings.ament.background = 10;

  const Shown shown = ShownBy(Method::Ament2017, scene);

  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int)
    {
      const double across = std::hypot(i - 16, j - 16) / 16;
      if (across > coreRadius + 0.25) // the border of the ball and what the means of rays read
      {
        EXPECT_EQ(shown.extinction[node], scene.extinction[node]);
      }
    });
}

TEST(Ament2017, ClearsForTheLightAsForACameraInItsPlace)
{
  BoxScene scene({ 17, 21, 13 }, { 3, -2, 5 }, { 1.0, 1.3, 0.8 });
  scene.FillOnion();
  const Shown shown = ShownBy(Method::Ament2017, scene);
  scene.camera.position = scene.light.position;

  const Shown fromThere = ShownBy(Method::Ament2017, scene);

  const float most = *std::max_element(scene.extinction.begin(), scene.extinction.end());
  for (std::size_t node = 0; node < scene.extinction.size(); ++node)
  {
    // The fields may lie in another order, so sums are rounded in another one.
    EXPECT_NEAR(shown.lightExtinction[node], fromThere.extinction[node], 1e-5 * most);
  }
}

TEST(Ament2017, KeepsEverySmoothedShareBetweenThoseOfItsNeighbours)
{
  BoxScene scene = BoxScene::Cube(21);
  scene.FillOnion();
  scene.settings.ament.smoothingPasses = 0;
  const Shown rough = ShownBy(Method::Ament2017, scene);
  scene.settings.ament.smoothingPasses = 1;

  const Shown smooth = ShownBy(Method::Ament2017, scene);

  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      if (!(scene.extinction[node] > 0))
      {
        return;
      }
      float least = 1;
      float most = 0;
      for (int n = 0; n < 27; ++n)
      {
        const Int3 at(i + n % 3 - 1, j + n / 3 % 3 - 1, k + n / 9 - 1);
        const bool inside =
          at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x < 21 && at.y < 21 && at.z < 21;
        const std::size_t other =
          inside ? std::size_t(at.x) + 21 * (std::size_t(at.y) + 21 * std::size_t(at.z)) : node;
        if (scene.extinction[other] > 0)
        {
          const float share = rough.extinction[other] / scene.extinction[other];
          least = std::min(least, share);
          most = std::max(most, share);
        }
      }
      const float share = smooth.extinction[node] / scene.extinction[node];
      EXPECT_GE(share, least - 1e-6f);
      EXPECT_LE(share, most + 1e-6f);
    });
}

TEST(AmentWeights, SayWhatIsWrong)
{
  const auto refused = [](auto set)
  {
    Settings settings;
    set(settings.ament);
    EXPECT_THROW(settings.Require(), Error);
  };
  refused([](AmentWeights& weights) { weights.regularization = 0; });
  refused([](AmentWeights& weights) { weights.exponent = -1; });
  refused([](AmentWeights& weights) { weights.occluders = std::nan(""); });
  refused(
    [](AmentWeights& weights) { weights.background = std::numeric_limits<double>::infinity(); });
  refused([](AmentWeights& weights) { weights.smoothingPasses = -1; });
  refused([](AmentWeights& weights) { weights.lightOccluders = -2; });
  refused([](AmentWeights& weights) { weights.lightBackground = -2; });
}
