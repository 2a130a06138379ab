// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Media that stop most light between two nodes: what is seen of them, its derivative, and what the
// solver makes of them.

#include "BoxScene.h"
#include "NodeImportanceOfAll.h"
#include "RandomScene.h"
#include "Tolerance.h"

#include "energy/VisibilityTerm.h"
#include "optimize/PreparedScene.h"
#include "optimize/Terms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

using namespace limpid;

namespace
{
/// `nodes` nodes along each axis, one apart, with a parallel camera along `direction`.
BoxScene SceneAlong(int nodes, const Vec3& direction)
{
  BoxScene scene(Int3(nodes), Vec3(0.0), Vec3(1.0));
  scene.camera.parallel = true;
  scene.camera.position = scene.grid.Centre() - 40.0 * glm::normalize(direction);
  scene.camera.focalPoint = scene.grid.Centre();
  scene.camera.viewUp = Vec3(0, 1, 0.1);
  return scene;
}

/// What the camera sees; into `gradient`, where it is not null, the derivative of minus that.
double ScoreOf(const BoxScene& scene, std::vector<float>* gradient = nullptr)
{
  const Occupancy filled(scene.grid, scene.extinction.data(), scene.importance.data(), true);
  VisibilityTerm<HostDevice> term(HostDevice::Shared(), scene.grid, filled,
    SourceOfCamera(scene.camera, scene.grid, false), scene.settings.rayDensity);
  const std::vector<float> nodeImportance =
    NodeImportanceOfAll(scene.grid, scene.importance.data());
  const TermFields fields{ scene.extinction.data(), scene.importance.data(),
    nodeImportance.data() };
  Seen seen;
  if (gradient)
  {
    gradient->assign(scene.extinction.size(), 0.0f);
    term.Differentiate(fields, Derivative::Volume, { 0.0f, 1.0f }, gradient->data(), &seen);
  }
  else
  {
    term.Forward(fields, &seen);
  }
  return seen.all.visible;
}

/// Noise in extinction, up to `most`, and importance.
void FillNoise(BoxScene& scene, double most, std::uint64_t seed)
{
  RandomNumbers random(seed);
  for (std::size_t node = 0; node < scene.extinction.size(); ++node)
  {
    scene.extinction[node] = static_cast<float>(random.Between(0, most));
    scene.importance[node] = static_cast<float>(std::max(0.0, random.Between(-1, 1)));
  }
}

/// Importance and extinction of the rear half, with a ramp to it over one layer.
BoxScene OpaqueBlock(double extinction)
{
  BoxScene scene = SceneAlong(9, Vec3(0, 0, 1));
  scene.Fill([=](const Vec3& x) { return x.z >= 4 ? extinction : 0.0; },
    [](const Vec3& x) { return x.z >= 4 ? 1.0 : 0.0; });
  return scene;
}
}

TEST(ThickMedia, ShowAsMuchOfAnOpaqueBlockAsTheIntegral)
{
  for (const double extinction : { 0.1, 1.0, 3.0, 10.0, 13.8, 30.0, 100.0, 1000.0 })
  {
    SCOPED_TRACE(extinction);
    // In the ramp g = z and mu = extinction z; behind it 1 and the extinction.
    double ramp = 0;
    const int steps = 200000;
    for (int n = 0; n < steps; ++n)
    {
      const double z = (n + 0.5) / steps;
      ramp += z * z * extinction * std::exp(-0.5 * extinction * z * z) / steps;
    }
    const double behind = std::exp(-0.5 * extinction) * (1 - std::exp(-4 * extinction));
    const double expected = 64 * (ramp + behind);

    const double found = ScoreOf(OpaqueBlock(extinction));

    const double ceiling = 64;
    EXPECT_WITHIN(found, expected,
      extinction > 100 ? Relative(5e-3, ceiling, "parts thicker than 1")
                       : Relative(5e-3, expected, "the bar of the issue"));
  }
}

namespace
{
struct OpaqueShape
{
  const char* name;
  double (*density)(const Vec3& x); ///< of extinction and importance, about the middle [0, 1]
};

const OpaqueShape opaqueShapes[] = {
  { "block", [](const Vec3& x) { return x.x > -2 && x.y > -2 && x.z > -2 ? 1.0 : 0.0; } },
  { "shell", [](const Vec3& x) { return std::exp(-std::pow((glm::length(x) - 4) / 1.2, 2)); } },
  { "sheet",
    [](const Vec3& x)
    { return std::max(0.0, 1 - std::abs(glm::dot(x, Vec3(0.18, 0.44, 0.88))) / 1.5); } },
  { "waves",
    [](const Vec3& x)
    {
      return std::max(
        0.0, std::sin(0.5 * x.x + 1) * std::sin(0.45 * x.y + 2) * std::sin(0.4 * x.z + 1.5));
    } },
};
}

// Rays across the faces of cells meet the skin of what is opaque anywhere within a layer.
TEST(ThickMedia, HaveTheScoreOfAFineMarchFromAnyDirection)
{
  for (const OpaqueShape& shape : opaqueShapes)
  {
    for (const Vec3& direction : { Vec3(0, 0, 1), Vec3(1, 0.7, 2), Vec3(1, 1, 1) })
    {
      for (const double extinction : { 1.0, 30.0 })
      {
        SCOPED_TRACE(::testing::Message() << shape.name << ' ' << direction.y << ' ' << extinction);
        BoxScene scene = SceneAlong(11, direction);
        scene.settings.maximumIterations = 0;
        const auto density = [&](const Vec3& x) { return shape.density(x - scene.grid.Centre()); };
        scene.Fill([&](const Vec3& x) { return extinction * density(x); }, density);

        const double march = scene.TrueScore(scene.extinction, 8);

        EXPECT_WITHIN(scene.MakeSolver().BaseScore().visibility, march,
          Relative(5e-3, march, "the bar of the issue"));
      }
    }
  }
}

// In perspective, the few rays in a strip beside the edge of what is opaque meet it where they may.
TEST(ThickMedia, HaveTheScoreOfABlockStraightAlongItsSides)
{
  for (const double distance : { 30.0, 40.0, 60.0 })
  {
    for (const double extinction : { 10.0, 100.0 })
    {
      SCOPED_TRACE(::testing::Message() << distance << ' ' << extinction);
      BoxScene scene = SceneAlong(25, Vec3(1, 0, 0));
      scene.camera.parallel = false;
      scene.camera.position = scene.grid.Centre() - Vec3(distance, 0, 0);
      scene.settings.maximumIterations = 0;
      const auto density = [&](const Vec3& x)
      { return opaqueShapes[0].density(x - scene.grid.Centre()); };
      scene.Fill([&](const Vec3& x) { return extinction * density(x); }, density);

      const double march = scene.TrueScore(scene.extinction, 16);

      EXPECT_WITHIN(scene.MakeSolver().BaseScore().visibility, march,
        Relative(5e-3, march, "the bar of the issue"));
    }
  }
}

// Rays along an axis meet fields that are linear between nodes, so that nothing but the quadrature
// and the gathering at the nodes can be wrong.
TEST(ThickMedia, HaveTheDerivativeOfWhatIsSummed)
{
  for (const double most : { 0.3, 3.0, 30.0 })
  {
    SCOPED_TRACE(most);
    BoxScene scene = SceneAlong(7, Vec3(0, 0, 1));
    FillNoise(scene, most, 3);
    std::vector<float> gradient;
    ScoreOf(scene, &gradient);

    double squares = 0;
    double errors = 0;
    scene.ForEachNode(
      [&](std::size_t node, int i, int j, int k)
      {
        double share = 1; // of the node's cell that is inside the box
        for (const int n : { i, j, k })
        {
          share *= n == 0 || n == 6 ? 0.5 : 1.0;
        }
        BoxScene more = scene;
        BoxScene less = scene;
        more.extinction[node] += static_cast<float>(1e-3 * most);
        less.extinction[node] =
          std::max(less.extinction[node] - static_cast<float>(1e-3 * most), 0.0f);
        const double difference = -(ScoreOf(more) - ScoreOf(less)) /
          (double(more.extinction[node]) - less.extinction[node]);
        squares += difference * difference;
        errors += std::pow(share * gradient[node] - difference, 2);
      });

    EXPECT_LT(std::sqrt(errors / squares), 0.01); // differences of scores that are sums of floats
  }
}

namespace
{
/// An important sheet of one node across the view of 2 (mu h = 10), in front of which is nothing.
BoxScene OpaqueSheet()
{
  BoxScene scene = SceneAlong(9, Vec3(0, 0, 1));
  scene.Fill([](const Vec3& x) { return x.z == 4 ? 10.0 : 0.0; },
    [](const Vec3& x) { return x.z == 4 ? 1.0 : 0.0; });
  scene.settings.weights.light = 0;
  return scene;
}

/// The energy of an extinction, by a solver that starts from it.
double EnergyOf(const BoxScene& scene, const std::vector<float>& extinction)
{
  BoxScene still = scene;
  still.settings.maximumIterations = 0;
  Solver solver = still.MakeSolver();
  solver.SetInitialExtinction(extinction.data());
  solver.Run();
  return solver.BestEnergy().Total();
}
}

TEST(ThickMedia, AreThinnedWhereThatShowsMore)
{
  const BoxScene scene = OpaqueSheet();
  Solver solver = scene.MakeSolver();
  solver.Run();

  for (const double share : { 1.0, 0.6, 0.3, 0.2, 0.1 })
  {
    SCOPED_TRACE(share);
    std::vector<float> thinned = scene.extinction;
    for (float& value : thinned)
    {
      value *= static_cast<float>(share);
    }
    EXPECT_LE(solver.BestEnergy().Total(), 0.999 * EnergyOf(scene, thinned));
  }
}

// Every second node is opaque, and every third block of eight is important.
TEST(ThickMedia, AreSolvedAsWellWithAnyNumberOfIterations)
{
  BoxScene scene(Int3(10), Vec3(-1.54038226, -32.24576601, 63.08064666), Vec3(1.0));
  scene.grid.direction = glm::dmat3(-0.47180539, -0.75066118, -0.4625013, -0.40428794, 0.65034506,
    -0.6431194, 0.78355021, -0.1164435, -0.61031957);
  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      scene.extinction[node] = (i + j + k) % 2 == 1 ? 2.2259567f : 0.0f;
      scene.importance[node] = (i / 2 + j / 2 + k / 2) % 3 == 0 ? 0.020007964f : 0.0f;
    });
  scene.camera.position = Vec3(3.67152702, -7.67458571, 65.08392231);
  scene.camera.focalPoint = Vec3(-1.49263214, -34.262855, 44.68420483);
  scene.camera.viewUp = Vec3(0.1, 1, 0.3);
  scene.settings.weights.light = 0;
  BoxScene others = scene;
  others.settings.solver = SolverKind::Adam;
  Solver adam = others.MakeSolver();
  adam.Run();
  const double other = adam.BestEnergy().Total();
  for (const int iterations : { 2, 4, 8, 16 })
  {
    SCOPED_TRACE(iterations);
    scene.settings.maximumIterations = iterations;
    Solver policy = scene.MakeSolver();
    policy.Run();

    EXPECT_LE(policy.BestEnergy().Total(), other + 1e-3 * std::abs(other));
  }
}

TEST(ThickMedia, AreSolvedAsWellAsByDescent)
{
  for (const double most : { 10.0 })
  {
    for (const double protect : { 0.0, 1.0 })
    {
      for (const double emphasis : { 0.0, 1.0 })
      {
        SCOPED_TRACE(::testing::Message() << most << ", " << protect << ", " << emphasis);
        BoxScene scene = SceneAlong(13, Vec3(0.3, 0.2, 1));
        scene.Fill(
          [=](const Vec3& x)
          {
            return most *
              (0.5 + 0.5 * std::sin(0.9 * x.x) * std::sin(0.8 * x.y + 1) * std::sin(0.7 * x.z));
          },
          [](const Vec3& x) {
            return std::max(
              0.0, std::sin(0.9 * x.x) * std::sin(0.8 * x.y + 1) * std::sin(0.7 * x.z));
          });
        scene.settings.protectImportance = protect;
        scene.settings.emphasis = emphasis;
        Solver policy = scene.MakeSolver();
        policy.Run();
        scene.settings.solver = SolverKind::Adam;
        Solver adam = scene.MakeSolver();
        adam.Run();

        const double found = policy.BestEnergy().Total();
        const double other = adam.BestEnergy().Total();
        // On real scenes it is a thousandth; waves with a protected crest are the worst seen, 0.52
        // %.
        EXPECT_LE(found, other + 6e-3 * std::abs(other));
        EXPECT_LE(found, policy.History().front().energy.Total());
      }
    }
  }
}

TEST(ThickMedia, AreSolvedSoThatNoSmallChangeGains)
{
  constexpr int nodes = 12;
  RandomNumbers random(7);
  for (const double depth : { 0.3, 3.0, 14.0, 40.0 }) // from node to node
  {
    for (const double protect : { 0.0, 1.0 })
    {
      BoxScene scene = SceneAlong(nodes, Vec3(1, 0.7, 2));
      FillNoise(scene, depth, 11);
      scene.settings.protectImportance = protect;
      scene.settings.emphasis = 0;
      Solver solver = scene.MakeSolver();
      solver.Run();
      const std::vector<float> found = solver.Extinction();

      PreparedScene prepared(scene.Fields());
      const Problem problem = prepared.ProblemFor(scene.camera, scene.light, scene.settings);
      Terms<HostDevice> terms(HostDevice::Shared(), problem);
      terms.MeasureBase();
      const double energy = terms.Measure(found.data()).energy.Total();
      for (int change = 0; change < 50; ++change)
      {
        std::vector<float> other = found;
        const int side = change % 2 == 0 ? 1 : random.IntegerBetween(2, 4);
        const Int3 corner(random.IntegerBetween(0, nodes - side),
          random.IntegerBetween(0, nodes - side), random.IntegerBetween(0, nodes - side));
        const double share =
          random.Chance(0.5) ? random.Between(0, 1) : random.IntegerBetween(0, 1);
        for (int z = corner.z; z < corner.z + side; ++z)
        {
          for (int y = corner.y; y < corner.y + side; ++y)
          {
            for (int x = corner.x; x < corner.x + side; ++x)
            {
              const auto node = std::size_t((z * nodes + y) * nodes + x);
              const double least = protect * double(scene.importance[node]);
              other[node] =
                static_cast<float>(scene.extinction[node] * (least + share * (1 - least)));
            }
          }
        }
        // 0.3 % is the most that was seen, of 24000 changes of noise and waves.
        EXPECT_LE(energy - terms.Measure(other.data()).energy.Total(), 5e-3 * std::abs(energy))
          << depth << ' ' << protect << ' ' << change;
      }
    }
  }
}
