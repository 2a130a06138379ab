// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Pictures of the methods that compose the samples of a ray by their importance.

#include "RenderScene.h"
#include "Tolerance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

using namespace limpid;

namespace
{
constexpr int cells = 64; // along the rays
constexpr double thickness = 2;
constexpr double width = 0.5; // of both slabs, in a box of length 2
const std::array<float, 3> frontColor{ { 1, 0, 0.2f } };
const std::array<float, 3> rearColor{ { 0, 1, 0.6f } };

Grid BoxAlongZ()
{
  Grid grid;
  grid.nodes = Int3(3, 3, cells + 1);
  grid.origin = Vec3(-1);
  grid.spacing = Vec3(1, 1, 2.0 / cells);
  return grid;
}

/// A red slab in front and a green one behind, seen along z in parallel rays. Scalars: 0 red, 1
/// green, 0.5 nothing. `reversed`: from the other end.
RenderScene TwoSlabs(float frontImportance, float rearImportance, bool reversed = false)
{
  RenderScene scene = RenderScene::Homogeneous(BoxAlongZ(), thickness, frontColor);
  scene.functions.extinction.clear();
  scene.functions.color.clear();
  for (int entry = 0; entry <= 100; ++entry)
  {
    const bool filled = entry < 30 || entry > 70;
    scene.functions.extinction.push_back(filled ? float(thickness) : 0.0f);
    scene.functions.color.push_back(entry < 50 ? frontColor : rearColor);
  }
  scene.importance.assign(scene.scalars.size(), 0.0f);
  for (std::size_t node = 0; node < scene.scalars.size(); ++node)
  {
    const double z = -1 + 2.0 * double(node / 9) / cells;
    const bool front = z >= -0.75 && z <= -0.75 + width;
    const bool rear = z >= 0.25 && z <= 0.25 + width;
    scene.scalars[node] = front ? 0.0f : (rear ? 1.0f : 0.5f);
    const bool nearFront = std::abs(z + 0.5) < 0.4;
    const bool nearRear = std::abs(z - 0.5) < 0.4;
    scene.importance[node] = nearFront ? frontImportance : (nearRear ? rearImportance : 0.0f);
  }
  scene.view.width = scene.view.height = 4;
  scene.view.clipToWorld = glm::dmat4(1.0);
  scene.view.clipToWorld[2][2] = reversed ? -1 : 1;
  scene.view.sampleDistance = 0.25;
  return scene;
}

std::array<double, 4> PixelOf(const RenderScene& scene)
{
  const Picture picture = scene.Render();
  std::array<double, 4> pixel{};
  std::copy_n(picture.rgba.begin(), 4, pixel.begin());
  return pixel;
}

void ExpectPixel(const RenderScene& scene, const std::array<double, 3>& color, double opacity)
{
  const std::array<double, 4> found = PixelOf(scene);
  // Borders of slabs lie within 0.3 of a cell; 8-bit rounding is half a level.
  const Tolerance border{ 255 * 4 * 0.3 * thickness * 2 / cells * std::exp(-1.0) + 0.5,
    "four borders within 0.3 of a cell, and a pixel's level" };
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    EXPECT_WITHIN(found[channel], 255 * opacity * color[channel], border);
  }
  EXPECT_WITHIN(found[3], 255 * opacity, border);
}

std::array<double, 3> Blended(double share)
{
  std::array<double, 3> color{};
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    color[channel] = share * double(frontColor[channel]) + (1 - share) * double(rearColor[channel]);
  }
  return color;
}

RenderScene RandomScene(Compositing compositing, bool lit)
{
  RenderScene scene = RenderScene::Random(7, BoxAlongZ(), 6);
  scene.grid.nodes = Int3(23, 19, 27);
  scene.grid.spacing = Vec3(2.0) / (Vec3(scene.grid.nodes) - 1.0);
  scene = RenderScene::Random(7, scene.grid, 6);
  scene.lighting.enabled = lit;
  scene.lighting.shadows = false;
  std::mt19937 generator(3);
  scene.importance = RenderScene::Waves(scene.grid, generator);
  for (float& value : scene.importance)
  {
    value = std::min(std::max(3 * value - 1, 0.0f), 1.0f);
  }
  scene.compositing = compositing;
  return scene;
}
}

TEST(RendererMethods, DrawFromTheMostImportantObjectOn)
{
  RenderScene scene = TwoSlabs(0.6f, 1);
  scene.compositing = Compositing::FromObject;

  ExpectPixel(scene, Blended(0), 1 - std::exp(-thickness * width));
}

TEST(RendererMethods, DrawAllFromTheForemostOfEqualObjectsOn)
{
  RenderScene scene = TwoSlabs(1, 1);
  scene.compositing = Compositing::FromObject;
  const double front = 1 - std::exp(-thickness * width);
  const double all = 1 - std::exp(-2 * thickness * width);

  ExpectPixel(scene, Blended(front / all), all);
}

TEST(RendererMethods, DrawOrdinaryWhereThereIsNoObject)
{
  for (const bool lit : { false, true })
  {
    RenderScene scene = RandomScene(Compositing::FromObject, lit);
    for (float& value : scene.importance)
    {
      value *= 0.5f;
    }
    RenderScene ordinary = scene;
    ordinary.importance.clear();

    EXPECT_EQ(scene.Render().rgba, ordinary.Render().rgba);
  }
}

TEST(RendererMethods, GiveTheMeanColourByImportanceFromEitherSide)
{
  for (const bool reversed : { false, true })
  {
    RenderScene scene = TwoSlabs(0.25f, 1, reversed);
    scene.compositing = Compositing::ImportanceMean;

    ExpectPixel(scene, Blended(0.25 / 1.25), 1 - std::exp(-2 * thickness * width));
  }
}

TEST(RendererMethods, GiveThePlainMeanWhereNothingIsImportant)
{
  RenderScene scene = TwoSlabs(0, 0);
  scene.compositing = Compositing::ImportanceMean;

  ExpectPixel(scene, Blended(0.5), 1 - std::exp(-2 * thickness * width));
}

TEST(RendererMethods, AreFrontToBackWithoutImportance)
{
  for (const Compositing compositing : { Compositing::FromObject, Compositing::ImportanceMean })
  {
    RenderScene scene = RandomScene(compositing, true);
    const std::vector<float> importance = std::exchange(scene.importance, {});
    Renderer renderer;
    scene.SetUp(renderer);
    renderer.ComposeBy(compositing);
    Picture picture;

    renderer.Render(scene.WholeView(), picture);

    EXPECT_EQ(picture.rgba, scene.Render().rgba);
  }
}

TEST(RendererMethods, AreTheSameWithAndWithoutSkips)
{
  for (const Compositing compositing : { Compositing::FromObject, Compositing::ImportanceMean })
  {
    RenderScene scene = RandomScene(compositing, true);
    scene.view.jitter = true;
    const Picture with = scene.Render();
    scene.view.skipEmpty = false;
    const Picture without = scene.Render();

    int most = 0;
    for (std::size_t i = 0; i < with.rgba.size(); ++i)
    {
      most = std::max(most, std::abs(int(with.rgba[i]) - int(without.rgba[i])));
    }
    EXPECT_LE(most, 1) << "sums over blocks that begin elsewhere round differently";
  }
}
