// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Volume.h"

#include "backend/Backend.h"
#include "math/Require.h"

#include <cmath>

namespace limpid::benchmark
{
namespace
{
double Bell(double x, double width)
{
  return std::exp(-x * x / (width * width));
}
}

SceneForSolver MakeVolume(const std::string& filling, int nodes)
{
  LIMPID_REQUIRE(
    (filling == "onion" || filling == "dense" || filling == "waves") && nodes >= 2 && nodes <= 2048,
    "There is no volume \"" << filling << "\" with " << nodes
                            << " nodes along each axis (it is a formula). Choose onion, dense or "
                               "waves, and 2 to 2048 nodes.");
  constexpr double majorant = 12; // [1/length]
  const double haze = filling == "dense" ? 0.02 : 0.0;
  SceneForSolver scene;
  scene.name = filling;
  scene.grid.nodes = Int3(nodes);
  scene.grid.origin = Vec3(-1);
  scene.grid.spacing = Vec3(2.0 / (nodes - 1));
  const auto count = static_cast<std::size_t>(scene.grid.NodeCount());
  scene.extinction.resize(count);
  scene.importance.resize(count);
  ParallelFor(scene.grid.NodeCount(), 4096,
    [&](Index node)
    {
      const Index row = node / nodes;
      const Int3 place(int(node % nodes), int(row % nodes), int(row / nodes));
      const Vec3 x = scene.grid.PointToWorld(Vec3(place));
      const double fromCore = glm::length(x - Vec3(0.1, -0.1, 0.15));
      const double value = 0.5 * Bell(glm::length(x) - 0.75, 0.12) + Bell(fromCore, 0.35);
      scene.extinction[std::size_t(node)] =
        static_cast<float>(majorant * (value < 0.02 ? haze : std::min(1.0, value)));
      scene.importance[std::size_t(node)] =
        static_cast<float>(std::clamp(1.6 - 4 * fromCore, 0.0, 1.0));
      if (filling == "waves")
      {
        scene.extinction[std::size_t(node)] = static_cast<float>(
          majorant * (0.55 + 0.45 * std::sin(9 * x.x) * std::sin(8 * x.y) * std::sin(7 * x.z)));
        scene.importance[std::size_t(node)] =
          static_cast<float>(0.5 + 0.45 * std::cos(5 * x.x + 4 * x.y - 6 * x.z));
      }
    });
  const double radius = scene.grid.Radius();
  scene.camera.focalPoint = scene.light.focalPoint = scene.grid.Centre();
  scene.camera.position = scene.grid.Centre() + radius * Vec3(0.9, 1.3, -3);
  scene.light.position = scene.grid.Centre() + radius * Vec3(-1, 3, -0.7);
  return scene;
}

Orbit OrbitAround(const Grid& grid)
{
  Orbit orbit;
  orbit.centre = grid.Centre();
  orbit.distance = 3 * grid.Radius();
  return orbit;
}

std::vector<Vec3> SpreadDirections(int count)
{
  const double goldenAngle = std::acos(-1.0) * (3 - std::sqrt(5.0));
  std::vector<Vec3> directions;
  for (int i = 0; i < count; ++i)
  {
    const double z = 1 - (2 * i + 1.0) / count;
    const double radius = std::sqrt(1 - z * z);
    const double angle = goldenAngle * (i + 0.5);
    directions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return directions;
}
}
