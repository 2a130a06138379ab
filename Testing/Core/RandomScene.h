// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Small scenes at random, as awkward as they come: few nodes, flat voxels, turned grids, eyes far
// away, inside, on nodes, and grazing the faces.

#ifndef limpid_testing_RandomScene_h
#define limpid_testing_RandomScene_h

#include "BoxScene.h"
#include "OneOf.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace limpid
{
/// Numbers that are the same with every standard library.
class RandomNumbers
{
public:
  explicit RandomNumbers(std::uint64_t seed)
    : Engine(seed)
  {
  }

  double Between(double low, double high)
  {
    return low + (high - low) * double(this->Engine() >> 11) / 9007199254740992.0;
  }

  int IntegerBetween(int low, int high)
  {
    return low + static_cast<int>(this->Engine() % std::uint64_t(high - low + 1));
  }

  bool Chance(double probability) { return this->Between(0, 1) < probability; }

  double PowerOfTen(double low, double high) { return std::pow(10.0, this->Between(low, high)); }

  double Sign() { return this->Chance(0.5) ? 1.0 : -1.0; }

  Vec3 Direction()
  {
    Vec3 direction(0.0);
    while (glm::length(direction) < 0.1 || glm::length(direction) > 1)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        direction[axis] = this->Between(-1, 1);
      }
    }
    return glm::normalize(direction);
  }

  Mat3 Rotation()
  {
    const Vec3 first = this->Direction();
    const Vec3 second = glm::normalize(glm::cross(first, this->Direction()));
    return Mat3(first, second, glm::cross(first, second));
  }

private:
  std::mt19937_64 Engine;
};

/// Where rays come from: a position, or a direction of travel.
struct RandomEye
{
  bool parallel = false;
  Vec3 position{ 0.0 };
  Vec3 focalPoint{ 0.0 };
};

inline RandomEye MakeRandomEye(RandomNumbers& random, const Grid& grid)
{
  const double radius = std::max(grid.Radius(), 1e-3);
  const auto indexIn = [&](double before, double behind)
  {
    Vec3 index(0.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      index[axis] = random.Between(-before * grid.nodes[axis], behind * grid.nodes[axis] - 1);
    }
    return index;
  };
  RandomEye eye;
  eye.focalPoint = grid.PointToWorld(indexIn(0, 1));
  const int kind = random.IntegerBetween(0, 7);
  if (kind == 0) // near
  {
    eye.position = grid.Centre() + random.Direction() * radius * random.Between(1.1, 4);
  }
  else if (kind == 1) // far
  {
    eye.position = grid.Centre() + random.Direction() * radius * random.PowerOfTen(1, 6);
  }
  else if (kind <= 3) // inside, on a node or not
  {
    const Vec3 index = indexIn(0, 1);
    eye.position = grid.PointToWorld(kind == 2 ? index : glm::round(index));
    eye.focalPoint = eye.position + random.Direction();
  }
  else if (kind <= 5) // in the plane of a face or almost so
  {
    Vec3 index = indexIn(2, 3);
    const int axis = random.IntegerBetween(0, 2);
    const double beside = kind == 4 ? 0.0 : random.Sign() * random.PowerOfTen(-7, -1);
    index[axis] = (random.Chance(0.5) ? 0 : grid.nodes[axis] - 1) + beside;
    eye.position = grid.PointToWorld(index);
  }
  else // parallel, anyhow or about along an axis or a diagonal
  {
    Vec3 direction = random.Direction();
    if (kind == 7)
    {
      const Vec3 beside = direction * (random.Chance(0.3) ? 1e-6 : 0.0);
      const bool diagonal = random.Chance(0.5);
      const int axis = random.IntegerBetween(0, 2);
      for (int other = 0; other < 3; ++other)
      {
        direction[other] =
          other == axis ? random.Sign() : (diagonal ? random.IntegerBetween(-1, 1) : 0);
      }
      direction = grid.direction * ((direction + beside) * grid.spacing);
    }
    eye.parallel = true;
    eye.focalPoint = grid.Centre();
    eye.position = eye.focalPoint - 3.0 * direction;
  }
  return eye;
}

inline void LookFrom(const RandomEye& eye, Camera& camera)
{
  camera.parallel = eye.parallel;
  camera.position = eye.position;
  camera.focalPoint = eye.focalPoint;
}

inline void ShineFrom(const RandomEye& lamp, Light& light)
{
  light.type = lamp.parallel ? LightType::Directional : LightType::Point;
  light.position = lamp.position;
  light.focalPoint = lamp.focalPoint;
}

/// One to twelve nodes along each axis, at a ray density of about 1.
inline BoxScene MakeRandomScene(std::uint64_t seed)
{
  RandomNumbers random(seed);
  Int3 nodes;
  Vec3 spacing;
  Vec3 origin;
  for (int axis = 0; axis < 3; ++axis)
  {
    nodes[axis] = random.Chance(0.4) ? random.IntegerBetween(1, 3) : random.IntegerBetween(2, 12);
    const double most = random.Chance(0.5) ? 0.2 : 1.0;
    spacing[axis] = random.PowerOfTen(-most, most);
    origin[axis] = random.Between(-5, 5);
  }
  BoxScene scene(nodes, origin, spacing);
  if (random.Chance(0.7))
  {
    scene.grid.direction = random.Rotation();
  }
  const double majorant = random.PowerOfTen(-1, 2) / std::max(scene.grid.Radius(), 1e-3);
  const double filled = random.Chance(0.4) ? random.Between(0.02, 0.2) : 1.0;
  const double important = random.Chance(0.6) ? random.Between(0, 0.15) : random.Between(0, 1);
  for (std::size_t node = 0; node < scene.extinction.size(); ++node)
  {
    scene.extinction[node] =
      random.Chance(filled) ? static_cast<float>(random.Between(0, majorant)) : 0.0f;
    scene.importance[node] =
      random.Chance(important) ? static_cast<float>(random.Between(0, 1)) : 0.0f;
  }
  scene.importance[scene.importance.size() / 2] = 1;

  LookFrom(MakeRandomEye(random, scene.grid), scene.camera);
  ShineFrom(MakeRandomEye(random, scene.grid), scene.light);
  scene.settings.rayDensity = random.Chance(0.5) ? 1.0 : random.Between(0.5, 3);
  scene.settings.weights.light = random.Chance(0.5) ? 0 : 1;
  scene.settings.protectImportance = random.Chance(0.5) ? 0 : random.Between(0, 1);
  scene.settings.importanceSmoothing =
    random.Chance(0.7) ? ImportanceSmoothing::Off : ImportanceSmoothing::Median;
  scene.settings.emphasis =
    random.Chance(0.5) ? 1 : (random.Chance(0.5) ? 0 : random.Between(0, 1));
  return scene;
}
}

#endif
