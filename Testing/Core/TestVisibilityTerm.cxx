// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The derivative of a visibility term against central differences of the reference's score.

#include "BoxScene.h"
#include "NodeImportanceOfAll.h"
#include "Tolerance.h"

#include "energy/VisibilityTerm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
const int nodes = 49;
const double radius = std::sqrt(3.0);

using Field = std::function<double(const Vec3&)>;

struct Case
{
  std::string name;
  std::function<void(BoxScene&)> arrange;
};

std::ostream& operator<<(std::ostream& stream, const Case& value)
{
  return stream << value.name;
}

Field Ball(const Vec3& centre, double width, double height)
{
  return [=](const Vec3& x)
  { return height * std::exp(-glm::dot(x - centre, x - centre) / (width * width)); };
}

/// A smooth random direction: eight soft balls of either sign, smaller towards the sides of the
/// box.
Field RandomDirection(unsigned seed)
{
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> place(-0.6, 0.6);
  std::uniform_real_distribution<double> height(-1, 1);
  std::vector<Field> balls;
  for (int n = 0; n < 8; ++n)
  {
    const double x = place(generator);
    const double y = place(generator);
    const double z = place(generator);
    balls.push_back(Ball(Vec3(x, y, z), 0.4, height(generator)));
  }
  return [=](const Vec3& x)
  {
    double sum = 0;
    for (const Field& ball : balls)
    {
      sum += ball(x);
    }
    return sum;
  };
}

/// Central difference of the reference's score along a direction.
double Difference(const BoxScene& scene, const Field& direction, double step)
{
  std::vector<double> importance(scene.importance.begin(), scene.importance.end());
  const auto score = [&](double e)
  {
    std::vector<double> extinction(scene.extinction.begin(), scene.extinction.end());
    scene.ForEachNode([&](std::size_t node, int i, int j, int k)
      { extinction[node] += e * direction(scene.grid.PointToWorld(Vec3(i, j, k))); });
    truth::Sampling sampling;
    sampling.raysPerVoxel = 2;
    return truth::VisibilityScore(
      truth::Volume<double>{ scene.Lattice(), extinction.data(), importance.data() }, scene.Eye(),
      sampling);
  };
  return (score(step) - score(-step)) / (2 * step);
}

/// What the core says the same derivative is, from its gradient at the voxels.
double FromGradient(const BoxScene& scene, const Field& direction, Derivative derivative)
{
  const Occupancy everything(
    scene.grid, scene.extinction.data(), scene.importance.data(), scene.settings.skipUnneeded);
  VisibilityTerm<HostDevice> term(HostDevice::Shared(), scene.grid, everything,
    SourceOfCamera(scene.camera, scene.grid, false), scene.settings.rayDensity);
  std::vector<float> gradient(scene.extinction.size(), 0.0f);
  const std::vector<float> nodeImportance =
    NodeImportanceOfAll(scene.grid, scene.importance.data());
  Seen seen;
  term.Differentiate({ scene.extinction.data(), scene.importance.data(), nodeImportance.data() },
    derivative, { 1.0f, 1.0f }, gradient.data(), &seen);
  double sum = 0;
  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      double share = 1; // of a cell that belongs to the node
      share *= i == 0 || i == scene.grid.nodes.x - 1 ? 0.5 : 1;
      share *= j == 0 || j == scene.grid.nodes.y - 1 ? 0.5 : 1;
      share *= k == 0 || k == scene.grid.nodes.z - 1 ? 0.5 : 1;
      sum += share * gradient[node] * direction(scene.grid.PointToWorld(Vec3(i, j, k)));
    });
  return -sum * scene.grid.CellVolume(); // the gradient is that of -S
}

/// The size of the terms that the derivative is a difference of: integral of |d| g T.
double Magnitude(const BoxScene& scene, const Field& direction)
{
  std::vector<float> absolute = scene.importance;
  std::vector<float> ones(scene.importance.size(), 1.0f);
  double sum = 0;
  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      if (scene.importance[node] > 1e-4)
      {
        sum += std::abs(direction(scene.grid.PointToWorld(Vec3(i, j, k)))) *
          scene.importance[node] * scene.TrueTransmittance(i, j, k);
      }
    });
  return sum * scene.grid.CellVolume();
}

/// Soft fields, so that the sum over voxels is accurate: a veil in front of an important ball.
void FillSoft(BoxScene& scene)
{
  const Field veil = Ball(Vec3(0.1, 0.0, -0.35), 0.45, 2.0);
  const Field body = Ball(Vec3(0.0, 0.1, 0.25), 0.5, 3.0);
  const Field important = Ball(Vec3(0.0, 0.1, 0.25), 0.35, 1.0);
  scene.Fill([=](const Vec3& x) { return veil(x) + body(x); }, important);
}

const std::vector<Case> cases{
  { "camera outside", [](BoxScene& scene) { FillSoft(scene); } },
  { "camera near, rays widen much",
    [](BoxScene& scene)
    {
      FillSoft(scene);
      scene.camera.position = Vec3(0.3, -0.2, -1.6);
      scene.camera.focalPoint = Vec3(0);
    } },
  { "camera inside",
    [](BoxScene& scene)
    {
      FillSoft(scene);
      scene.camera.position = Vec3(0.12, -0.31, -0.83);
      scene.camera.focalPoint = Vec3(0);
    } },
  { "parallel",
    [](BoxScene& scene)
    {
      FillSoft(scene);
      scene.camera.parallel = true;
      scene.camera.position = Vec3(1, 0.5, -3);
      scene.camera.focalPoint = Vec3(0);
    } },
};

class ScoreDerivative : public ::testing::TestWithParam<Case>
{
};

std::string NameOf(const ::testing::TestParamInfo<Case>& value)
{
  std::string name;
  for (const char c : value.param.name)
  {
    name += std::isalnum(c) ? c : '_';
  }
  return name;
}
}

TEST_P(ScoreDerivative, IsThatOfTheReference)
{
  BoxScene scene = BoxScene::Cube(nodes);
  GetParam().arrange(scene);
  for (unsigned seed = 1; seed <= 4; ++seed)
  {
    SCOPED_TRACE("direction " + std::to_string(seed));
    const Field direction = RandomDirection(seed);

    const double difference = Difference(scene, direction, 1e-3);
    const double derivative = FromGradient(scene, direction, Derivative::Volume);

    // The sum over voxels sees hat functions: h^2 / 12 of the Laplacian, 6 / w^2 for a ball of
    // width w = 0.35, of each of the two terms whose difference it is.
    const double h = scene.grid.spacing.x;
    const double share = h * h / 12 * 6 / (0.35 * 0.35);
    EXPECT_WITHIN(derivative, difference,
      Relative(0.01, difference, "the issue's bar") +
        Relative(share, Magnitude(scene, direction), "sum over nodes") +
        Relative(1e-3, difference, "sum over rays, as for scores"));
  }
}

INSTANTIATE_TEST_SUITE_P(Smooth, ScoreDerivative, ::testing::ValuesIn(cases), NameOf);

TEST(ScoreDerivative, MissesTheWideningOfTheRaysAsPrintedInThePaper)
{
  BoxScene scene = BoxScene::Cube(nodes);
  FillSoft(scene);
  scene.camera.position = Vec3(0.3, -0.2, -1.6);
  scene.camera.focalPoint = Vec3(0);
  const Field inFront = Ball(Vec3(0.1, 0.0, -0.4), 0.4, 1.0);

  const double difference = Difference(scene, inFront, 1e-3);
  const double volume = FromGradient(scene, inFront, Derivative::Volume);
  const double ray = FromGradient(scene, inFront, Derivative::Ray);

  EXPECT_WITHIN(volume, difference, Relative(0.02, difference, "sum over nodes"));
  EXPECT_LT(std::abs(ray), 0.8 * std::abs(difference));
}

TEST(VisibilityTerm, CarriesTheVisibleImportanceOfTheReferenceToEveryVoxel)
{
  BoxScene scene = BoxScene::Cube(nodes);
  FillSoft(scene);
  const Occupancy everything(scene.grid, scene.extinction.data(), scene.importance.data(), false);
  for (const Derivative derivative : { Derivative::Volume, Derivative::Ray })
  {
    VisibilityTerm<HostDevice> term(HostDevice::Shared(), scene.grid, everything,
      SourceOfCamera(scene.camera, scene.grid, false), 2.0);
    std::vector<float> gradient(scene.extinction.size(), 0.0f);
    // At a point, as the march computes it, it is g at the point that counts.
    Seen seen;
    term.Differentiate(
      { scene.extinction.data(), scene.importance.data(), scene.importance.data() }, derivative,
      { 1.0f, 1.0f }, gradient.data(), &seen);

    double largestInside = 0;
    double largestOnBorder = 0;
    const auto widening =
      derivative == Derivative::Volume ? truth::Widening::Counted : truth::Widening::Ignored;
    scene.ForEachNode(
      [&](std::size_t node, int i, int j, int k)
      {
        if (node % 7 != 0)
        {
          return;
        }
        const truth::Vector x = ToTruth(scene.grid.PointToWorld(Vec3(i, j, k)));
        const truth::Volume<float> volume = scene.TruthWith(scene.extinction);
        const double expected = truth::VisibleBehind(volume, scene.Eye(), x, widening) -
          scene.importance[node] * truth::Transmittance(volume, scene.Eye(), x);
        const bool inside = std::min({ i, j, k }) > 0 && std::max({ i, j, k }) < nodes - 1;
        double& largest = inside ? largestInside : largestOnBorder;
        largest = std::max(largest, std::abs(gradient[node] - expected));
      });

    // The derivative is the mean over the hat function of the node: h^2 / 12 of second derivatives
    // along three axes, of fields of height 1 with curvature 2 / w^2 plus (mu)^2, and half of that
    // for midpoints between rays. On the border the hat is one-sided: h / 3 of the slope 1 / w.
    const double h = scene.grid.spacing.x;
    const double curvature = 2 / (0.35 * 0.35) + 5 * 5;
    const Tolerance hat{ h * h / 8 * 3 * curvature, "mean over a hat function" };
    EXPECT_WITHIN(largestInside, 0, hat);
    EXPECT_WITHIN(largestOnBorder, 0, hat + (Tolerance{ h / 3 / 0.35, "one-sided" }));
  }
}

namespace
{
/// A number in [0, 1) that looks random, the same every time.
double Noise(std::size_t node, unsigned seed)
{
  std::mt19937 generator(static_cast<unsigned>(node) * 2654435761u + seed);
  return std::uniform_real_distribution<double>(0, 1)(generator);
}

/// Derivative of the reference's score with respect to the extinction of one node, per volume.
double OfNode(const BoxScene& scene, std::size_t node)
{
  const double step = 1e-2;
  double difference = 0;
  for (const double side : { -1.0, 1.0 })
  {
    std::vector<double> extinction(scene.extinction.begin(), scene.extinction.end());
    const std::vector<double> importance(scene.importance.begin(), scene.importance.end());
    extinction[node] += side * step;
    truth::Sampling sampling;
    sampling.raysPerVoxel = 6;
    difference += side *
      truth::VisibilityScore(
        truth::Volume<double>{ scene.Lattice(), extinction.data(), importance.data() }, scene.Eye(),
        sampling);
  }
  return difference / (2 * step * scene.grid.CellVolume());
}
}

// What policy and descent act on: of one node, in fields that change from node to node.
TEST(ScoreDerivative, OfANodeIsTheMeanOverItsHatAndNotTheValueThere)
{
  BoxScene scene = BoxScene::Cube(13);
  for (std::size_t node = 0; node < scene.extinction.size(); ++node)
  {
    scene.extinction[node] = static_cast<float>(4 * Noise(node, 1));
    scene.importance[node] = static_cast<float>(std::max(2 * Noise(node, 2) - 1, 0.0));
  }
  const Occupancy everything(scene.grid, scene.extinction.data(), scene.importance.data(), false);
  VisibilityTerm<HostDevice> term(HostDevice::Shared(), scene.grid, everything,
    SourceOfCamera(scene.camera, scene.grid, false), 2.0);
  std::vector<float> gradient(scene.extinction.size(), 0.0f);
  const std::vector<float> nodeImportance =
    NodeImportanceOfAll(scene.grid, scene.importance.data());
  Seen seen;
  term.Differentiate({ scene.extinction.data(), scene.importance.data(), nodeImportance.data() },
    Derivative::Volume, { 1.0f, 1.0f }, gradient.data(), &seen);

  double ofMean = 0;
  double ofValue = 0;
  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      if (i < 2 || i > 10 || j < 2 || j > 10 || k < 2 || k > 10 || node % 17 != 0)
      {
        return;
      }
      const double expected = OfNode(scene, node);
      const truth::Vector x = ToTruth(scene.grid.PointToWorld(Vec3(i, j, k)));
      const truth::Volume<float> volume = scene.TruthWith(scene.extinction);
      const double value = nodeImportance[node] * truth::Transmittance(volume, scene.Eye(), x) -
        truth::VisibleBehind(volume, scene.Eye(), x, truth::Widening::Counted);
      ofMean += std::pow(-gradient[node] - expected, 2);
      ofValue += std::pow(value - expected, 2);
    });

  std::cout << "rms error, mean / value: " << std::sqrt(ofMean / ofValue) << "\n";
  // What remains is the image: its rays are midpoints, two across a node.
  EXPECT_LT(ofMean, 0.3 * 0.3 * ofValue);
}
