// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// One extinction for several cameras: which they are, what the energy is, and what comes of it.

#include "BoxScene.h"
#include "PretendedClock.h"
#include "Tolerance.h"

#include "math/Angle.h"
#include "math/Number.h"
#include "math/Require.h"
#include "optimize/PreparedScene.h"
#include "optimize/Progressive.h"
#include "optimize/Terms.h"
#include "scene/ViewSet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace limpid;

namespace
{
Solver RunFor(const BoxScene& scene, const std::vector<Camera>& cameras)
{
  Solver solver(scene.Fields(), cameras.front(), scene.light, ForCameras(scene.settings, cameras));
  solver.Run();
  return solver;
}

std::vector<Camera> OrbitOf(const BoxScene& scene, int count)
{
  return CamerasOf({ ViewKind::Orbit, count }, scene.camera, OrbitStart::AtCamera);
}

/// The mean of what the reference sees from all cameras.
double TrueMean(
  BoxScene scene, const std::vector<Camera>& cameras, const std::vector<float>& extinction)
{
  double sum = 0;
  for (const Camera& camera : cameras)
  {
    scene.camera = camera;
    sum += scene.TrueScore(extinction);
  }
  return sum / double(cameras.size());
}

class SeveralViews : public ::testing::TestWithParam<SolverKind>
{
protected:
  BoxScene Scene() const
  {
    BoxScene scene = BoxScene::Onion(25);
    scene.settings.solver = GetParam();
    scene.settings.iterationsPerLevel = { { 8, 8, 48 } };
    return scene;
  }
};
}

INSTANTIATE_TEST_SUITE_P(Solvers, SeveralViews,
  ::testing::Values(SolverKind::Policy, SolverKind::Adam),
  [](const auto& solver) { return solver.param == SolverKind::Policy ? "Policy" : "Adam"; });

TEST_P(SeveralViews, TellTheMeanScoreThatTheReferenceSees)
{
  BoxScene scene = this->Scene();
  scene.FillOnion(4);            // no layer is thick,
  scene.settings.rayDensity = 4; // so that iterations see what scores do
  const std::vector<Camera> cameras = OrbitOf(scene, 3);

  const Solver solver = RunFor(scene, cameras);

  const double before = TrueMean(scene, cameras, scene.extinction);
  const double after = TrueMean(scene, cameras, solver.Extinction());
  const char* const why = "quadrature is of second order, measured 0.3 % on this scene";
  EXPECT_WITHIN(solver.BaseScore().visibility, before, Relative(1e-2, before, why));
  EXPECT_WITHIN(solver.BestScore().visibility, after, Relative(1e-2, after, why));
  EXPECT_GT(after, 1.5 * before);
  const double weight = scene.settings.weights.view;
  EXPECT_WITHIN(solver.BestEnergy().view, -weight * solver.BestScore().visibility,
    Relative(1e-12, weight * after, "one sum, in another order"));
}

// What is best for one of them is not better for all.
TEST_P(SeveralViews, AreServedBetterTogetherThanByAnyOneOfThem)
{
  const BoxScene scene = this->Scene();
  const std::vector<Camera> cameras = OrbitOf(scene, 4);

  const double together = TrueMean(scene, cameras, RunFor(scene, cameras).Extinction());

  double best = 0;
  for (const Camera& camera : cameras)
  {
    const double other = TrueMean(scene, cameras, RunFor(scene, { camera }).Extinction());
    EXPECT_GT(together, 1.1 * other);
    BoxScene one = scene;
    one.camera = camera;
    best += one.TrueScore(RunFor(scene, { camera }).Extinction()) / double(cameras.size());
  }
  EXPECT_LT(together, best);
  EXPECT_GT(together, 0.6 * best);
}

// Both have equal energies, hence the same optimum.
TEST_P(SeveralViews, OfOneCameraTwiceAreThatOfOne)
{
  const BoxScene scene = this->Scene();

  const Solver once = RunFor(scene, { scene.camera });
  const Solver twice = RunFor(scene, { scene.camera, scene.camera });

  EXPECT_EQ(twice.BaseScore().visibility, once.BaseScore().visibility);
  EXPECT_WITHIN(twice.BestEnergy().Total(), once.BestEnergy().Total(),
    Relative(0.02, once.BestEnergy().Total(), "both end where an iteration gains little"));
}

TEST_P(SeveralViews, DoNotDependOnThreads)
{
  const BoxScene scene = this->Scene();
  const std::vector<Camera> cameras = OrbitOf(scene, 3);
  EXPECT_EQ(RunFor(scene, cameras).Extinction(), RunFor(scene, cameras).Extinction());
}

TEST_P(SeveralViews, HaveASecondExtinctionForTheLightInSeparateMode)
{
  BoxScene scene = this->Scene();
  scene.settings.mode = Mode::Separate;
  const Solver one = RunFor(scene, { scene.camera });
  const Solver several = RunFor(scene, OrbitOf(scene, 3));
  EXPECT_EQ(several.LightExtinction(), one.LightExtinction());
  EXPECT_NE(several.Extinction(), one.Extinction());
}

TEST(Terms, AreTheCamerasWithTheirSharesAndThenTheLight)
{
  const BoxScene scene = BoxScene::Onion(9);
  const std::vector<Camera> cameras = OrbitOf(scene, 3);
  PreparedScene prepared(scene.Fields());
  Settings settings = ForCameras(scene.settings, cameras);
  const Weights& weights = settings.weights;
  const auto isOfCamera = [&]
  {
    const Problem problem = prepared.ProblemFor(cameras.front(), scene.light, settings);
    const Terms<HostDevice> terms(HostDevice::Shared(), problem);
    std::vector<bool> found;
    double view = 0;
    for (const auto& term : terms.all)
    {
      EXPECT_EQ(term.Number(), found.size());
      found.push_back(term.IsOfCamera());
      view += term.IsOfCamera() ? term.Weight() : 0;
      EXPECT_TRUE(term.IsOfCamera() || term.Weight() == weights.light);
    }
    EXPECT_WITHIN(view, weights.view, Roundoff<double>(4, weights.view));
    return found;
  };

  EXPECT_EQ(isOfCamera(), (std::vector<bool>{ true, true, true, false }));
  settings.weights.light = 0;
  EXPECT_EQ(isOfCamera(), (std::vector<bool>{ true, true, true }));
  settings.weights.light = 2;
  settings.weights.view = 0;
  EXPECT_EQ(isOfCamera(), (std::vector<bool>{ false }));
}

// A derivative of the mean is the mean of derivatives.
TEST(Terms, SumTheDerivativesOfAllCameras)
{
  const BoxScene scene = BoxScene::Onion(17);
  const std::vector<Camera> cameras = OrbitOf(scene, 3);
  PreparedScene prepared(scene.Fields());
  const auto differentiate = [&](const std::vector<Camera>& seen)
  {
    Settings settings = ForCameras(scene.settings, seen);
    settings.weights.light = 0;
    const Problem problem = prepared.ProblemFor(seen.front(), scene.light, settings);
    std::vector<float> gradient(scene.extinction.size(), 0.0f);
    Terms<HostDevice>(HostDevice::Shared(), problem)
      .Differentiate(scene.extinction.data(), gradient.data());
    return gradient;
  };

  const std::vector<float> together = differentiate(cameras);

  std::vector<double> mean(together.size());
  for (const Camera& camera : cameras)
  {
    const std::vector<float> one = differentiate({ camera });
    for (std::size_t node = 0; node < one.size(); ++node)
    {
      mean[node] += double(one[node]) / double(cameras.size());
    }
  }
  for (std::size_t node = 0; node < mean.size(); ++node)
  {
    ASSERT_WITHIN(together[node], mean[node], Roundoff<float>(8, scene.settings.weights.view));
  }
}

TEST(ViewSet, IsTheCameraAlone)
{
  const BoxScene scene = BoxScene::Onion(5);
  const std::vector<Camera> cameras = CamerasOf({}, scene.camera, OrbitStart::Fixed);
  ASSERT_EQ(cameras.size(), 1u);
  EXPECT_TRUE(cameras[0] == scene.camera);
}

TEST(ViewSet, HasTwoEyesThatSeeTheFocalPointFromLeftAndRight)
{
  BoxScene scene = BoxScene::Onion(5);
  scene.camera.corners = { scene.camera.focalPoint + Vec3(1, 0, 0) };
  const Camera& camera = scene.camera;

  const std::vector<Camera> eyes =
    CamerasOf({ ViewKind::StereoPair, 8, 3.0 }, camera, OrbitStart::Fixed);

  ASSERT_EQ(eyes.size(), 2u);
  const Vec3 offset = camera.position - camera.focalPoint;
  const Vec3 right = glm::cross(camera.viewUp, offset);
  const double rounding = 1e-12;
  for (const Camera& eye : eyes)
  {
    const Vec3 other = eye.position - eye.focalPoint;
    EXPECT_NEAR(glm::length(other), glm::length(offset), rounding);
    EXPECT_NEAR(AngleBetween(other, offset), 1.5 * pi / 180, rounding);
    EXPECT_NEAR(glm::dot(other, camera.viewUp), glm::dot(offset, camera.viewUp), 1e-3);
    EXPECT_NEAR(AngleBetween(eye.corners[0] - eye.focalPoint, other),
      AngleBetween(camera.corners[0] - camera.focalPoint, offset), rounding);
  }
  EXPECT_LT(glm::dot(eyes[0].position - camera.position, right), 0);
  EXPECT_GT(glm::dot(eyes[1].position - camera.position, right), 0);
}

TEST(ViewSet, GoesRoundAtTheSameHeightAndDistance)
{
  BoxScene scene = BoxScene::Onion(5);
  scene.camera.viewUp = Vec3(0.05, 0.02, -1); // rolled a little
  const Camera& camera = scene.camera;
  const Vec3 offset = camera.position - camera.focalPoint;

  const std::vector<Camera> cameras =
    CamerasOf({ ViewKind::Orbit, 5 }, camera, OrbitStart::AtCamera);

  ASSERT_EQ(cameras.size(), 5u);
  EXPECT_NEAR(glm::distance(cameras[0].position, camera.position), 0, 1e-12);
  for (std::size_t i = 0; i < 5; ++i)
  {
    const Vec3 here = cameras[i].position - camera.focalPoint;
    const Vec3 next = cameras[(i + 1) % 5].position - camera.focalPoint;
    EXPECT_NEAR(here.z, offset.z, 1e-12);
    EXPECT_NEAR(glm::length(here), glm::length(offset), 1e-12);
    EXPECT_NEAR(AngleBetween(Vec3(here.x, here.y, 0), Vec3(next.x, next.y, 0)), 2 * pi / 5, 1e-12);
    EXPECT_NEAR(cameras[i].viewUp.z, camera.viewUp.z, 1e-12);
  }
}

// From wherever on it one looks, also along the axis, where there is no way round.
TEST(ViewSet, IsTheSameFromEverywhereOnAnOrbit)
{
  const BoxScene scene = BoxScene::Onion(5);
  const ViewSet views{ ViewKind::Orbit, 7 };
  const std::vector<Camera> expected = CamerasOf(views, scene.camera, OrbitStart::Fixed);
  for (const Camera& camera :
    CamerasOf({ ViewKind::Orbit, 36 }, scene.camera, OrbitStart::AtCamera))
  {
    const std::vector<Camera> found = CamerasOf(views, camera, OrbitStart::Fixed);
    for (std::size_t i = 0; i < 7; ++i)
    {
      EXPECT_NEAR(glm::distance(found[i].position, expected[i].position), 0, 1e-12);
      EXPECT_NEAR(glm::distance(found[i].viewUp, expected[i].viewUp), 0, 1e-12);
    }
  }
  Camera above = scene.camera;
  above.position = above.focalPoint + Vec3(0, 3, 0);
  for (const Camera& camera : CamerasOf(views, above, OrbitStart::Fixed))
  {
    EXPECT_NEAR(glm::distance(camera.position, above.position), 0, 1e-12);
  }
}

TEST(ViewSet, RejectsWhatItCannotWorkWith)
{
  const BoxScene scene = BoxScene::Onion(5);
  for (const ViewSet& views : { ViewSet{ ViewKind::Orbit, 0 }, ViewSet{ ViewKind::Orbit, 361 },
         ViewSet{ ViewKind::StereoPair, 8, -1.0 }, ViewSet{ ViewKind::StereoPair, 8, 180.0 },
         ViewSet{ ViewKind::StereoPair, 8, std::nan("") } })
  {
    EXPECT_THROW(CamerasOf(views, scene.camera, OrbitStart::Fixed), Error);
  }
  BoxScene other = scene;
  other.settings.method = Method::Viola2004;
  EXPECT_THROW(RunFor(other, OrbitOf(scene, 2)), Error);
  Camera nowhere = scene.camera;
  nowhere.position.x = std::nan("");
  EXPECT_THROW(RunFor(scene, { scene.camera, nowhere }), Error);
}

// A preview is made of all of them, and what is refined is what a solver finds.
TEST(Progressive, PreviewsAndRefinesForSeveralViews)
{
  const BoxScene scene = BoxScene::Onion(25);
  const std::vector<Camera> cameras = OrbitOf(scene, 3);
  const Settings settings = ForCameras(scene.settings, cameras);
  Progressive progressive(scene.Fields(), scene.settings);
  const PretendedClock clock(1e-10);
  progressive.SetView(cameras.front(), scene.light, settings);

  progressive.Preview(1);
  EXPECT_GT(progressive.BestScore().visibility, 1.2 * progressive.BaseScore().visibility);
  EXPECT_WITHIN(progressive.BestScore().visibility,
    TrueMean(scene, cameras,
      { progressive.Extinction(), progressive.Extinction() + scene.extinction.size() }),
    Relative(1e-2, progressive.BestScore().visibility, "quadrature is of second order"));
  while (!progressive.Refine())
  {
  }

  const Solver solver = RunFor(scene, cameras);
  EXPECT_EQ(progressive.BestScore().visibility, solver.BestScore().visibility);
  const Scores one = progressive.ScoresFrom(cameras[1]);
  EXPECT_NE(one.best.visibility, solver.BestScore().visibility);
}
