// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The paper's own scheme as a whole, against closed forms and against the independent ray march.

#include "RayMarch.h"
#include "Tolerance.h"

#include "PaperScheme/PaperScheme.h"
#include "backend/Backend.h"
#include "math/Require.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace
{
using namespace limpid;
using namespace limpid::reference;

/// A cube of `nodes`^3 nodes over [-1, 1]^3 and its fields.
struct Cube
{
  explicit Cube(int nodes)
  {
    grid.nodes = Int3(nodes);
    grid.origin = Vec3(-1);
    grid.spacing = Vec3(2.0 / (nodes - 1));
    extinction.resize(grid.NodeCount());
    importance.resize(grid.NodeCount());
  }

  static Cube Homogeneous(int nodes, float extinction)
  {
    Cube cube(nodes);
    std::fill(cube.extinction.begin(), cube.extinction.end(), extinction);
    std::fill(cube.importance.begin(), cube.importance.end(), 1.0f);
    return cube;
  }

  /// An important ball in the middle of a veil.
  static Cube Veiled(int nodes)
  {
    Cube cube(nodes);
    for (Index node = 0; node < cube.grid.NodeCount(); ++node)
    {
      const Index row = node / nodes;
      const Index slice = row / nodes;
      const Vec3 index(double(node % nodes), double(row % nodes), double(slice));
      const Vec3 position = cube.grid.PointToWorld(index);
      const double outward = glm::dot(position, position);
      cube.extinction[node] = float(2 * std::exp(-outward));
      cube.importance[node] = float(std::exp(-6 * outward));
    }
    return cube;
  }

  SceneFields Fields() const { return { grid, extinction.data(), importance.data() }; }

  truth::Volume<float> Truth() const
  {
    truth::Volume<float> volume;
    for (int axis = 0; axis < 3; ++axis)
    {
      volume.lattice.nodes[axis] = grid.nodes[axis];
      volume.lattice.origin[axis] = grid.origin[axis];
      volume.lattice.spacing[axis] = grid.spacing[axis];
    }
    volume.extinction = extinction.data();
    volume.importance = importance.data();
    return volume;
  }

  Grid grid;
  std::vector<float> extinction;
  std::vector<float> importance;
};

const Vec3 camera(3, 2, 2.5);
const Vec3 light(-2, 4, 1);

PaperSettings WithSamples(double samplesPerVoxel)
{
  PaperSettings settings;
  settings.samplesPerVoxel = samplesPerVoxel;
  return settings;
}

truth::Source SourceAt(const Vec3& position)
{
  return truth::Source::Point({ { position.x, position.y, position.z } });
}
}

// Seen squarely from so far that the rays are parallel, Eq. (32) is A (1 - exp(-mu L)), and its
// left Riemann sum is a geometric series: larger by x / (1 - exp(-x)), x = mu h.
TEST(PaperScheme, ConvergesToTheScoreOfAHomogeneousBoxSeenSquarely)
{
  const Cube cube = Cube::Homogeneous(9, 0.8f);
  const double distance = 1e6;
  const double exact = 4 * (1 - std::exp(-double(0.8f) * 2));
  double lastError = 0;

  for (const double samplesPerVoxel : { 1, 2, 4, 8 })
  {
    const PaperScheme<double> scheme(
      cube.Fields(), { 0, 0, distance }, light, WithSamples(samplesPerVoxel));
    const double x = double(0.8f) * 2 / scheme.CameraMap().cells.z;
    const double expected = exact * x / (1 - std::exp(-x));

    // Depth and width of a cell, and with them the sum, vary by the box's depth over the distance.
    const Tolerance perspective = Relative(4 * 2 / distance, expected, "the rays' divergence");
    EXPECT_WITHIN(scheme.Score(), expected, perspective);

    const double error = scheme.Score() / exact - 1;
    if (lastError > 0)
    {
      // error = x/2 + x^2/12 - ...: halving x halves it but for the second term.
      EXPECT_WITHIN(error / lastError, 0.5, (Tolerance{ x / 6, "second order of the sum" }));
    }
    lastError = error;
  }
}

// Obliquely there are no whole cells at the faces: first order, too, with x/2 of the sum and at
// most as much again of the faces.
TEST(PaperScheme, ConvergesToTheScoreOfAHomogeneousBoxSeenObliquely)
{
  const Cube cube = Cube::Homogeneous(9, 0.8f);
  truth::Sampling fine;
  fine.minimumRays = 512;
  const double exact = truth::VisibilityScore(cube.Truth(), SourceAt(camera), fine);

  for (const double samplesPerVoxel : { 1, 2, 4, 8 })
  {
    const PaperScheme<double> scheme(cube.Fields(), camera, light, WithSamples(samplesPerVoxel));
    const PerspectiveMap<double>& map = scheme.CameraMap();
    const double x = double(0.8f) * cube.grid.Radius() * map.CellLength(0, 0);

    EXPECT_WITHIN(
      scheme.Score(), exact, Relative(x, exact, "first order in extinction times step"));
  }
}

// Eqs. (27) and (28) from the grids against the independent march, without the weight of the
// widening rays: each refinement by two halves the error of the left Riemann sums.
TEST(PaperScheme, ConvergesToTheRayDerivativeAtTheVoxels)
{
  const Cube cube = Cube::Veiled(9);
  const double radius = cube.grid.Radius();
  std::vector<double> gradient(cube.grid.NodeCount());
  double lastError = 0;

  for (const double samplesPerVoxel : { 4, 8, 16 })
  {
    const PaperScheme<double> scheme(cube.Fields(), camera, light, WithSamples(samplesPerVoxel));
    scheme.Gradient(gradient.data());

    double error = 0;
    for (int k = 1; k < 8; k += 2)
    {
      for (int i = 1; i < 8; i += 2)
      {
        const Vec3 world = cube.grid.PointToWorld(Vec3(i, 3, k));
        const truth::Vector position{ { world.x, world.y, world.z } };
        const Index node = i + 9 * (3 + 9 * k);
        double expected = 0;
        for (const auto& [eye, weight] : { std::pair(camera, 10.0), std::pair(light, 1.0) })
        {
          const truth::Volume<float> volume = cube.Truth();
          expected += weight *
            (truth::VisibleBehind(volume, SourceAt(eye), position, truth::Widening::Ignored) -
              cube.importance[node] * truth::Transmittance(volume, SourceAt(eye), position));
        }
        error += std::abs(gradient[node] - expected);
      }
    }
    if (lastError > 0)
    {
      // One order, up to what is left of the second one.
      const double step = 2 * radius * scheme.CameraMap().CellLength(0, 0);
      EXPECT_WITHIN(error / lastError, 0.5, (Tolerance{ step, "second order in the step" }));
    }
    lastError = error;
  }
}

TEST(PaperScheme, ClearsTheViewWithinTheBounds)
{
  const Cube cube = Cube::Veiled(17);
  PaperScheme<float> scheme(cube.Fields(), camera, light, WithSamples(2));
  const double before = scheme.Score();

  for (int iteration = 0; iteration < 20; ++iteration)
  {
    scheme.Step();
  }

  EXPECT_GT(scheme.Score(), before);
  for (const float extinction : scheme.Extinction())
  {
    EXPECT_GE(extinction, 0);
    EXPECT_LE(extinction, float(scheme.Majorant()));
  }
}

TEST(PaperScheme, StaysAtTheBaseExtinctionWithoutWeights)
{
  const Cube cube = Cube::Veiled(9);
  PaperSettings settings;
  settings.weights.view = 0;
  settings.weights.light = 0;
  PaperScheme<double> scheme(cube.Fields(), camera, light, settings);

  scheme.Step();

  EXPECT_EQ(scheme.Extinction(), cube.extinction);
}

TEST(PaperScheme, DoesNotDependOnTheNumberOfThreads)
{
  const Cube cube = Cube::Veiled(17);
  std::vector<std::vector<float>> results;

  for (const int threads : { 1, 3 })
  {
    const ThreadLimit limit(threads);
    PaperScheme<float> scheme(cube.Fields(), camera, light, WithSamples(2));
    scheme.Step();
    scheme.Step();
    results.push_back(scheme.Extinction());
  }

  EXPECT_EQ(results[0], results[1]);
}

TEST(PaperScheme, RefusesAnEyeInsideTheData)
{
  const Cube cube = Cube::Veiled(9);

  EXPECT_THROW(PaperScheme<float>(cube.Fields(), { 0.1, 0, 0 }, light, {}), Error);
  EXPECT_THROW(PaperScheme<float>(cube.Fields(), camera, { 0.1, 0, 0 }, {}), Error);
}

TEST(PaperScheme, RefusesAVolumeWithoutOpacity)
{
  Cube cube = Cube::Veiled(9);
  std::fill(cube.extinction.begin(), cube.extinction.end(), 0.0f);

  EXPECT_THROW(PaperScheme<float>(cube.Fields(), camera, light, {}), Error);
}
