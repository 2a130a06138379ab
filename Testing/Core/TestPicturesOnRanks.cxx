// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Pictures that ranks draw together, of a piece each: those of one process.

#include "SceneOnRanks.h"

#include "Resampled.h"
#include "render/Renderer.h"
#include "scene/Resampling.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <vector>

using namespace limpid;

namespace
{
constexpr int layers = 3; ///< of neighbours' nodes: two more than samples are apart

/// What is drawn, of the whole or of a part.
struct Drawn
{
  DrawnPart part;
  std::vector<float> scalars;
  std::vector<float> base;
  std::vector<float> extinction;
};

/// Waves that absorb much or nothing, of which an optimisation has cleared a part.
Drawn Waves()
{
  Grid grid;
  grid.nodes = Int3(37, 30, 41);
  grid.origin = Vec3(1, -2, 3);
  grid.spacing = Vec3(0.1, 0.13, 0.09);
  Drawn drawn;
  drawn.part = grid;
  for (int k = 0; k < grid.nodes.z; ++k)
  {
    for (int j = 0; j < grid.nodes.y; ++j)
    {
      for (int i = 0; i < grid.nodes.x; ++i)
      {
        const double wave = std::sin(0.4 * i + 0.2 * k) * std::cos(0.35 * j) * std::sin(0.3 * k);
        const auto scalar = static_cast<float>(0.5 + 0.5 * wave);
        drawn.scalars.push_back(scalar);
        drawn.base.push_back(std::max(0.0f, 12 * (scalar - 0.4f)));
        drawn.extinction.push_back(i + j > 30 ? drawn.base.back() : 0.2f * drawn.base.back());
      }
    }
  }
  return drawn;
}

TransferFunctions Functions()
{
  TransferFunctions functions;
  for (int i = 0; i <= 64; ++i)
  {
    const float scalar = float(i) / 64;
    functions.extinction.push_back(std::max(0.0f, 12 * (scalar - 0.4f)));
    functions.color.push_back({ { scalar, 1 - scalar, 0.5f } });
  }
  return functions;
}

struct Look
{
  const char* name;
  Vec3 from; ///< [radii]
  bool lit;
  bool point;
  bool optimized;
  bool parallel;
};

void PrintTo(const Look& look, std::ostream* out)
{
  *out << look.name;
}

View ViewOf(const Grid& grid, const Look& look)
{
  View view;
  view.width = 120;
  view.height = 100;
  const Vec3 eye = grid.Centre() + grid.Radius() * look.from;
  const double aspect = double(view.width) / view.height;
  const double reach = 4 * grid.Radius();
  const double size = 1.1 * grid.Radius();
  const glm::dmat4 projection = look.parallel
    ? glm::ortho(-size * aspect, size * aspect, -size, size, 0.01, reach)
    : glm::perspective(glm::radians(40.0), aspect, 0.01 * grid.Radius(), reach);
  view.clipToWorld = glm::inverse(projection * glm::lookAt(eye, grid.Centre(), Vec3(0.1, 1, 0.05)));
  return view;
}

Lighting LightOf(const Grid& whole, const Look& look)
{
  Lighting lighting;
  lighting.enabled = look.lit;
  lighting.light.type = look.point ? LightType::Point : LightType::Directional;
  lighting.light.position = whole.Centre() + whole.Radius() * Vec3(1.2, 2, 0.8);
  lighting.light.focalPoint = whole.Centre();
  return lighting;
}

/// Calls take(picture) with one picture after the other.
using TakePicture = std::function<void(const Picture&)>;

void MakePicture(Renderer& renderer, const Drawn& drawn, const Look& look, const TakePicture& take)
{
  const Grid& whole = drawn.part.Whole();
  renderer.SetScalars(drawn.part, drawn.scalars.data());
  renderer.SetTransferFunctions(Functions());
  if (look.optimized)
  {
    renderer.SetExtinction(drawn.part, drawn.base.data(), drawn.extinction.data());
  }
  renderer.SetLighting(LightOf(whole, look));
  Picture picture;
  renderer.Render(ViewOf(whole, look), picture);
  take(picture);
}

/// From rest to motion and back, and halfway each time: what is shown comes in pieces and, on two
/// coarse grids, as a whole. `all`: the whole.
void MakeMovie(Renderer& renderer, const Drawn& drawn, const Drawn& all, const Look& look,
  const TakePicture& take)
{
  renderer.SetScalars(drawn.part, drawn.scalars.data());
  renderer.SetTransferFunctions(Functions());
  renderer.SetLighting(LightOf(all.part.Whole(), look));
  const auto shoot = [&]
  {
    Picture picture;
    renderer.Render(ViewOf(all.part.Whole(), look), picture);
    take(picture);
  };
  const auto rest = [&](double share)
  {
    renderer.SetExtinction(drawn.part, drawn.base.data(), drawn.extinction.data(), share);
    renderer.SetShadowCoarseness(1);
    shoot();
  };
  const auto move = [&](int factor, double share)
  {
    const Grid grid = CoarseGrid(all.part.Whole(), factor);
    const std::vector<float> base = Resampled(all.part.Whole(), all.base.data(), grid);
    std::vector<float> extinction = base;
    for (std::size_t node = 0; node < extinction.size() / 2; ++node)
    {
      extinction[node] *= 0.3f;
    }
    renderer.SetExtinction(grid, base.data(), extinction.data(), share);
    renderer.SetShadowCoarseness(2);
    shoot();
  };
  shoot();
  rest(1);
  renderer.SetShadowCoarseness(2);
  shoot();
  move(2, 0.4);
  move(2, 1);
  move(3, 0.5);
  rest(0.5);
  rest(1);
  renderer.SetExtinction(drawn.part, nullptr, nullptr);
  renderer.SetShadowCoarseness(2);
  shoot();
  move(3, 0.5);
}

/// `ranks`: how many have made the picture.
void ExpectSame(const Picture& expected, const Picture& picture, int ranks)
{
  ASSERT_EQ(picture.rgba.size(), expected.rgba.size());
  ASSERT_EQ(picture.foremost.size(), ranks > 1 ? expected.rgba.size() / 4 : 0);
  int farthest = 0;
  for (std::size_t i = 0; i < expected.rgba.size(); ++i)
  {
    farthest = std::max(farthest, std::abs(int(picture.rgba[i]) - int(expected.rgba[i])));
  }
  EXPECT_LE(farthest, 1); // of 255: one rounding, and rays that end where they are opaque
  for (std::size_t pixel = 0; pixel < picture.foremost.size(); ++pixel)
  {
    const std::int32_t foremost = picture.foremost[pixel];
    ASSERT_LT(foremost, ranks);
    ASSERT_GE(foremost, picture.rgba[4 * pixel + 3] > 0 ? 0 : -1);
  }
}

/// Makes pictures of what is there of a scene.
using Make = std::function<void(Renderer&, const Drawn& here, const TakePicture&)>;

void ExpectSameOnRanks(const Drawn& whole, const Make& make)
{
  const Grid& grid = whole.part.Whole();
  Renderer alone;
  std::vector<Picture> expected;
  make(alone, whole, [&](const Picture& picture) { expected.push_back(picture); });
  for (const Picture& picture : expected)
  {
    const auto seen = std::count_if(
      picture.rgba.begin(), picture.rgba.end(), [](std::uint8_t value) { return value > 100; });
    ASSERT_GT(seen, 2000) << "nothing is in the picture";
  }
  for (const int ranks : { 1, 2, 3, 4, 8 })
  {
    for (const int empty : { 0, 1 })
    {
      SCOPED_TRACE(::testing::Message() << ranks << " ranks, " << empty << " of them empty");
      if (empty == ranks)
      {
        continue;
      }
      const Pieces pieces = Slabs(grid.nodes, ranks % 3, ranks, empty);
      std::mutex access;
      std::vector<std::vector<std::int32_t>> foremost(expected.size()); // of all ranks alike
      ThreadRanks::Run(ranks,
        [&](const std::shared_ptr<const Communicator>& all)
        {
          const auto piece = Grown(ScenePiece(all, grid, pieces(all->Rank())), grid, layers);
          const auto cut = [&](const std::vector<float>& field)
          { return Cut(field, grid.nodes, piece->nodes); };
          const Drawn here{ { grid, piece }, cut(whole.scalars), cut(whole.base),
            cut(whole.extinction) };
          Renderer renderer;
          std::size_t number = 0;
          make(renderer, here,
            [&](const Picture& picture)
            {
              const std::lock_guard<std::mutex> lock(access);
              SCOPED_TRACE(::testing::Message() << "picture " << number);
              ASSERT_LT(number, expected.size());
              ExpectSame(expected[number], picture, ranks);
              std::vector<std::int32_t>& of = foremost[number++];
              of = of.empty() ? picture.foremost : of;
              EXPECT_EQ(of, picture.foremost);
            });
          EXPECT_EQ(number, expected.size());
        });
    }
  }
}

class SharedPicture : public ::testing::TestWithParam<Look>
{
};
}

TEST_P(SharedPicture, IsThatOfOneProcess)
{
  const Drawn whole = Waves();
  ExpectSameOnRanks(whole,
    [&](Renderer& renderer, const Drawn& here, const TakePicture& take)
    { MakePicture(renderer, here, GetParam(), take); });
}

TEST_P(SharedPicture, MovesAsThatOfOneProcess)
{
  const Drawn whole = Waves();
  ExpectSameOnRanks(whole,
    [&](Renderer& renderer, const Drawn& here, const TakePicture& take)
    { MakeMovie(renderer, here, whole, GetParam(), take); });
}

INSTANTIATE_TEST_SUITE_P(Ranks, SharedPicture,
  ::testing::Values(Look{ "Ordinary", Vec3(1, 0.7, 1.6), false, false, false, false },
    Look{ "Lit", Vec3(1, 0.7, 1.6), true, false, false, false },
    Look{ "Optimized", Vec3(-1, 0.7, -1.6), false, false, true, false },
    Look{ "LitAndOptimized", Vec3(1, -0.7, 1.6), true, false, true, false },
    Look{ "PointLight", Vec3(1, 0.7, -1.6), true, true, true, false },
    Look{ "Parallel", Vec3(0, 0, 2), true, false, true, true },
    Look{ "FromInside", Vec3(0.05, 0.1, 0.2), true, false, true, false }),
  [](const auto& tested) { return tested.param.name; });
