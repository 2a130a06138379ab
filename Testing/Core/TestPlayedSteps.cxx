// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A time series that is played faster than it can be optimised: no frame shows less of the
// important structures than the original does.

#include "BoxScene.h"
#include "Tolerance.h"

#include "optimize/Progressive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

using namespace limpid;

namespace
{
constexpr int stepCount = 20;

/// A hot core in a haze that goes to and fro between the eye and the back, and so comes to where
/// the haze was cleared to show it.
BoxScene Step(int number)
{
  BoxScene scene = BoxScene::Cube(25);
  const Vec3 toEye = glm::normalize(scene.camera.position - scene.camera.focalPoint);
  const Vec3 centre = 0.5 * std::sin(0.9 * number) * toEye;
  const auto core = [=](const Vec3& x)
  { return std::exp(-std::pow(glm::length(x - centre) / 0.2, 4)); };
  scene.Fill([=](const Vec3& x) { return glm::length(x) < 0.95 ? 1.5 + 8 * core(x) : 0.0; },
    [=](const Vec3& x) { return core(x) > 0.1 ? core(x) : 0.0; });
  return scene;
}

/// Scores of an extinction at all nodes of a scene, which nothing has carried.
Scores ScoresOf(const BoxScene& scene, const float* extinction)
{
  Solver solver = scene.MakeSolver();
  const Score base = solver.BaseScore();
  solver.SetInitialExtinction(extinction);
  return { base, solver.BestScore() };
}

struct Playing
{
  const char* name;
  double coherence;
  double emphasis;
  double previewSeconds; ///< 0: frames at rest
};

class PlayedSteps : public ::testing::TestWithParam<Playing>
{
protected:
  /// What frames of steps show: all within one iteration of the beginning, but for the first step.
  template <class Look>
  void Play(const Look& look) const
  {
    CarriedChange carried;
    for (int number = 0; number < stepCount; ++number)
    {
      BoxScene scene = Step(number);
      scene.settings.temporalCoherence = GetParam().coherence;
      scene.settings.emphasis = GetParam().emphasis;
      Progressive progressive(scene.Fields(), scene.settings);
      progressive.GoOnFrom(carried);
      progressive.SetView(scene.camera, scene.light, scene.settings);
      bool done = false;
      for (int frame = 0; !done && (frame < 2 || number == 0); ++frame)
      {
        const bool moves = GetParam().previewSeconds > 0 && number > 0;
        moves ? progressive.Preview(GetParam().previewSeconds) : void(done = progressive.Refine());
        look(progressive, scene);
      }
      carried = progressive.Change();
      carried.likeness = likenessInTime;
    }
  }
};
}

INSTANTIATE_TEST_SUITE_P(Ways, PlayedSteps,
  ::testing::Values(Playing{ "Free", 0, 0, 0 }, Playing{ "Steady", 0.5, 0, 0 },
    Playing{ "VerySteady", 100, 0, 0 }, Playing{ "Emphasised", 0.5, 0.5, 0 },
    Playing{ "Moving", 0, 0, 1 }, Playing{ "MovingSteadily", 0.5, 0, 1 },
    Playing{ "MovingVerySteadily", 100, 0, 1 }),
  [](const auto& playing) { return playing.param.name; });

TEST_P(PlayedSteps, NeverShowLessThanTheOriginal)
{
  int originals = 0;
  this->Play(
    [&](Progressive& progressive, const BoxScene& scene)
    {
      progressive.ShowNoLessThanBase();

      EXPECT_GE(progressive.BestScore().fraction, progressive.BaseScore().fraction);
      const bool isCoarse = progressive.ShownGrid().nodes != scene.grid.nodes;
      if (progressive.ShowsFound() && !isCoarse)
      {
        const Scores seen = ScoresOf(scene, progressive.Extinction());
        // One is summed from the front to the back of a ray, the other from the back to the front.
        const Tolerance rounding = Roundoff<float>(200, seen.base.fraction);
        EXPECT_GE(seen.best.fraction, seen.base.fraction - rounding.value);
      }
      else if (!progressive.ShowsFound())
      {
        EXPECT_EQ(progressive.Extinction(), progressive.BaseExtinction());
        EXPECT_EQ(progressive.LightExtinction(), progressive.BaseExtinction());
        ++originals;
      }
    });
  if (GetParam().previewSeconds == 0)
  {
    EXPECT_GT(originals, 0); // or nothing was tested
  }
}

// What is found in the end is what is found without looking.
TEST_P(PlayedSteps, FindWhatTheyFindUnwatched)
{
  const auto lastOf = [this](bool watches)
  {
    std::vector<float> last;
    this->Play(
      [&](Progressive& progressive, const BoxScene&)
      {
        if (watches)
        {
          progressive.ShowNoLessThanBase();
        }
        last = progressive.Change().ofExtinction;
      });
    return last;
  };

  EXPECT_EQ(lastOf(true), lastOf(false));
}
