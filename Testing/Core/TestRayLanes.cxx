// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Rays that walk past empty bricks side by side end where each ends alone.

#include "render/BrickDistances.h"
#include "render/RayLanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

using namespace limpid;

namespace
{
/// 7 x 5 x 6 bricks, of which a few have something.
struct Volume
{
  static constexpr int bricks[3] = { 7, 5, 6 };
  std::vector<std::uint8_t> distances;
  BrickDistances view;

  explicit Volume(unsigned int seed)
  {
    std::mt19937 random(seed);
    std::vector<Int3> filled;
    for (int i = 0; i < 6; ++i)
    {
      filled.emplace_back(random() % bricks[0], random() % bricks[1], random() % bricks[2]);
    }
    for (int brick = 0; brick < bricks[0] * bricks[1] * bricks[2]; ++brick)
    {
      const Int3 here(
        brick % bricks[0], brick / bricks[0] % bricks[1], brick / (bricks[0] * bricks[1]));
      int nearest = 255;
      for (const Int3& other : filled)
      {
        const Int3 way = glm::abs(other - here);
        nearest = std::min(nearest, std::max({ way.x, way.y, way.z }));
      }
      this->distances.push_back(static_cast<std::uint8_t>(nearest));
    }
    const int size = BrickDistances::size;
    this->view = BrickDistances::Of(
      Int3(size * bricks[0], size * bricks[1] - 2, size * bricks[2] + 1), this->distances.data());
  }
};

/// Rays through the volume, one along an axis, one without segments.
std::array<Ray, RayLanes::count> MakeRays(unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> share(0, 1);
  std::array<Ray, RayLanes::count> rays;
  for (int i = 0; i < RayLanes::count; ++i)
  {
    Ray& ray = rays[i];
    for (int axis = 0; axis < 3; ++axis)
    {
      const float last = float(BrickDistances::size * Volume::bricks[axis] - 3);
      ray.entry[axis] = last * share(random);
      ray.step[axis] = i == 3 && axis > 0 ? 0.0f : share(random) - 0.5f;
    }
    ray.length = 60 * share(random);
    ray.shift = share(random);
    ray.segments = i == 7 ? 0 : static_cast<int>(std::ceil(ray.length + ray.shift));
    ray.begin = static_cast<int>(3 * share(random));
  }
  return rays;
}
}

TEST(RayLanes, WalkAsEachRayDoesAlone)
{
  int skipped = 0;
  for (unsigned int seed = 0; seed < 50; ++seed)
  {
    const Volume volume(seed);
    const auto rays = MakeRays(seed);
    const RayLanes lanes(rays.data());
    std::int32_t ends[RayLanes::count];
    BrickWalk<RayLanes>(volume.view, lanes).SkipEmpty(lanes.begin).Store(ends);
    for (int i = 0; i < RayLanes::count; ++i)
    {
      EXPECT_EQ(ends[i], BrickWalk<Ray>(volume.view, rays[i]).SkipEmpty(rays[i].begin))
        << "ray " << i << " of seed " << seed;
      skipped += ends[i] - rays[i].begin;
    }
  }
  EXPECT_GT(skipped, 50 * RayLanes::count); // not all begin where something is
}

TEST(RayLanes, LeaveOutOnlyWhatIsEmpty)
{
  for (unsigned int seed = 0; seed < 50; ++seed)
  {
    const Volume volume(seed);
    for (const Ray& ray : MakeRays(seed))
    {
      const int end = BrickWalk<Ray>(volume.view, ray).SkipEmpty(ray.begin);
      for (int k = ray.begin; k < end; ++k)
      {
        int brick[3];
        for (int axis = 0; axis < 3; ++axis)
        {
          const float position = ray.entry[axis] + ray.At(k) * ray.step[axis];
          brick[axis] = volume.view.BrickAt(axis, position);
        }
        EXPECT_GT(volume.view.EmptyAround(brick), 0) << "sample " << k << " of seed " << seed;
      }
    }
  }
}
