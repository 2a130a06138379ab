// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Boxes, orbits and directions of the tests on viewpoints.

#ifndef limpid_testing_ViewScene_h
#define limpid_testing_ViewScene_h

#include "BoxScene.h"

#include "viewpoint/Search.h"

#include <cmath>
#include <ostream>
#include <random>
#include <vector>

namespace limpid
{
inline std::vector<Vec3> RandomDirections(int count)
{
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  std::vector<Vec3> directions;
  for (int i = 0; i < count; ++i)
  {
    const double x = normal(generator);
    const double y = normal(generator);
    const double z = normal(generator);
    directions.push_back(glm::normalize(Vec3(x, y, z)));
  }
  return directions;
}

inline Orbit OrbitOf(const Grid& grid, bool parallel)
{
  Orbit orbit;
  orbit.centre = grid.Centre();
  orbit.distance = 3 * grid.Radius();
  orbit.parallel = parallel;
  orbit.parallelScale = grid.Radius();
  return orbit;
}

/// What fills the box, on lengths of the half diagonal.
enum class Content
{
  Onion,   ///< nothing at the border
  Waves,   ///< fades to the border
  Borders, ///< cut off by the sides of the box
};

inline BoxScene Filled(Content content)
{
  BoxScene scene({ 41, 37, 45 }, { 10, -3, 2 }, { 1.0, 0.8, 1.2 });
  if (content == Content::Onion)
  {
    scene.FillOnion(6);
    return scene;
  }
  const double radius = scene.grid.Radius();
  const Vec3 centre = scene.grid.Centre();
  scene.Fill(
    [=](const Vec3& x)
    {
      const Vec3 y = (x - centre) / radius;
      const double waves = 1.2 + std::sin(5 * y.x + 1) * std::cos(4 * y.y) * std::sin(3 * y.z);
      return 2 / radius * waves * (content == Content::Waves ? std::exp(-8 * glm::dot(y, y)) : 1);
    },
    [=](const Vec3& x)
    {
      const Vec3 y = (x - centre) / radius;
      return 0.5 + 0.5 * std::sin(3 * y.x + 2 * y.z);
    });
  return scene;
}

/// A box and a projection.
struct Case
{
  const char* name;
  Content content;
  bool parallel;
};

inline std::ostream& operator<<(std::ostream& stream, const Case& one)
{
  return stream << one.name;
}
}

#endif
