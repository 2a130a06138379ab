// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The extinction that the optimisation gives: grids of their own, changes that ease in, empty
// nodes, and which of the fields casts the shadows.

#include "PictureErrors.h"
#include "RenderScene.h"
#include "Tolerance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace limpid;

namespace
{
const float notANumber = std::numeric_limits<float>::quiet_NaN();

RenderScene Ordinary()
{
  RenderScene scene =
    RenderScene::Random(4, MakeGrid({ 12, 10, 9 }, { 3, -1, 2 }, { 0.3, 0.4, 0.5 }), 8);
  scene.Change({ 12, 10, 9 }, 21);
  return scene;
}

std::vector<float> Between(
  const std::vector<float>& from, double share, const std::vector<float>& to)
{
  std::vector<float> result(from.size());
  for (std::size_t node = 0; node < from.size(); ++node)
  {
    result[node] = float(from[node] + share * (double(to[node]) - from[node]));
  }
  return result;
}

Picture Drawn(Renderer& renderer, const RenderScene& scene)
{
  Picture picture;
  renderer.Render(scene.WholeView(), picture);
  return picture;
}

/// Two pictures whose media differ by rounding of the change only.
void ExpectSameButRounding(
  const RenderScene& scene, const Picture& picture, const Picture& expected, double roundings)
{
  ASSERT_EQ(picture.rgba.size(), expected.rgba.size());
  double worst = 0;
  for (std::size_t byte = 0; byte < picture.rgba.size(); ++byte)
  {
    worst = std::max(worst, std::abs(picture.rgba[byte] - double(expected.rgba[byte])) / 255);
  }
  // A byte changes by one where the exact value is on the edge between two.
  const Tolerance stored = StoredMedium(scene);
  EXPECT_WITHIN(worst, 0,
    (Tolerance{ 1 / 255.0 + roundings * stored.value, "rounding to 8 bits, and of the change" }));
}
}

TEST(RendererExtinction, WithoutAnyIsThatOfTheTransferFunction)
{
  RenderScene scene = Ordinary();
  const Picture changed = scene.Render();
  scene.extinction = scene.base;
  const Picture unchanged = scene.Render();
  scene.extinction.clear();
  scene.base.clear();

  const Picture plain = scene.Render();

  EXPECT_EQ(plain.rgba, unchanged.rgba);
  EXPECT_NE(plain.rgba, changed.rgba);
}

TEST(RendererExtinction, IsThePartThatIsLeftAtTheNodes)
{
  RenderScene scene = Ordinary();
  scene.extinction.clear();
  scene.base.clear();
  scene.lighting.enabled = false;
  Renderer renderer;
  scene.SetUp(renderer);
  const std::vector<float> half(scene.scalars.size(), 0.5f);
  renderer.SetScalars(scene.grid, scene.scalars.data(), half.data());
  const Picture halved = Drawn(renderer, scene);

  for (float& extinction : scene.functions.extinction)
  {
    extinction *= 0.5f;
  }

  ExpectSameButRounding(scene, halved, scene.Render(), 1);
}

// With emphasis 0, nothing is thicker than the transfer functions make it, between the nodes, too:
// a share of theirs is left everywhere, which interpolates shares of at most 1.
TEST(RendererExtinction, WhereItIsOnlyRemovedNoPixelIsMoreOpaque)
{
  for (const unsigned seed : { 21u, 22u, 23u })
  {
    RenderScene scene =
      RenderScene::Random(4, MakeGrid({ 12, 10, 9 }, { 3, -1, 2 }, { 0.3, 0.4, 0.5 }), 8);
    scene.Change({ 12, 10, 9 }, seed);
    for (std::size_t node = 0; node < scene.base.size(); ++node)
    {
      scene.extinction[node] = std::min(scene.extinction[node], scene.base[node]);
    }
    const Picture removed = scene.Render();
    scene.extinction = scene.base;
    const Picture whole = scene.Render();

    int thinner = 0;
    for (std::size_t byte = 3; byte < whole.rgba.size(); byte += 4)
    {
      EXPECT_LE(removed.rgba[byte], whole.rgba[byte]) << byte;
      thinner += removed.rgba[byte] < whole.rgba[byte] ? 1 : 0;
    }
    EXPECT_GT(thinner, 0);
  }
}

TEST(RendererExtinction, IsForgottenWhenNullIsGiven)
{
  RenderScene scene = Ordinary();
  Renderer renderer;
  scene.SetUp(renderer);
  Drawn(renderer, scene);
  scene.extinction.clear();
  scene.base.clear();

  renderer.SetExtinction(scene.grid, nullptr, nullptr);

  EXPECT_EQ(Drawn(renderer, scene).rgba, scene.Render().rgba);
}

namespace
{
/// A share of an even base extinction is kept, so that a finer grid can hold the same field.
RenderScene Cleared()
{
  RenderScene scene =
    RenderScene::Random(4, MakeGrid({ 13, 9, 11 }, { 3, -1, 2 }, { 0.3, 0.4, 0.5 }), 8);
  scene.Change({ 7, 5, 6 }, 21);
  const float majorant =
    *std::max_element(scene.functions.extinction.begin(), scene.functions.extinction.end());
  std::fill(scene.base.begin(), scene.base.end(), majorant);
  return scene;
}

/// A field at the nodes of another grid over the same box.
std::vector<float> Sampled(const Grid& grid, const std::vector<float>& values, const Grid& other)
{
  const truth::Field<double> field = TruthOf(grid, values);
  std::vector<float> result;
  truth::ForEachNode(TruthOf(other),
    [&](int i, int j, int k)
    { result.push_back(float(field(TruthOf(other.PointToWorld(Vec3(i, j, k)))))); });
  return result;
}
}

TEST(RendererExtinction, OnAFinerGridOfTheSameFieldIsTheSamePicture)
{
  // A trilinear field on every second node, and the same sampled on all: with an odd number of
  // nodes every coarse node is a fine one, and the field has no kink elsewhere.
  const RenderScene coarse = Cleared();
  RenderScene fine = coarse;
  fine.changeGrid = fine.grid;
  fine.base = Sampled(coarse.changeGrid, coarse.base, fine.grid);
  fine.extinction = Sampled(coarse.changeGrid, coarse.extinction, fine.grid);

  ExpectSameButRounding(fine, fine.Render(), coarse.Render(), 2);
}

TEST(RendererExtinction, MovesHalfWayWithAShareOfAHalf)
{
  const RenderScene scene = Ordinary();
  RenderScene half = scene;
  half.extinction = Between(scene.base, 0.5, scene.extinction);
  Renderer renderer;
  scene.SetUp(renderer);
  renderer.SetExtinction(scene.changeGrid, scene.base.data(), scene.base.data());

  renderer.SetExtinction(scene.changeGrid, scene.base.data(), scene.extinction.data(), 0.5);

  ExpectSameButRounding(scene, Drawn(renderer, scene), half.Render(), 2);
}

TEST(RendererExtinction, MovesTheSameShareOfWhatIsLeftEachTime)
{
  const RenderScene scene = Ordinary();
  RenderScene expected = scene;
  expected.extinction = Between(scene.base, 1 - std::pow(0.7, 4), scene.extinction);
  Renderer renderer;
  scene.SetUp(renderer);
  renderer.SetExtinction(scene.changeGrid, scene.base.data(), scene.base.data());

  for (int frame = 0; frame < 4; ++frame)
  {
    renderer.SetExtinction(scene.changeGrid, scene.base.data(), scene.extinction.data(), 0.3);
  }

  ExpectSameButRounding(scene, Drawn(renderer, scene), expected.Render(), 5);
}

TEST(RendererExtinction, MovesFromTheTransferFunctionsWhenNothingElseIsShown)
{
  // Whether shadows were drawn before or not.
  for (const bool lit : { false, true })
  {
    RenderScene scene = Ordinary();
    scene.changeGrid = scene.grid;
    scene.lighting.enabled = lit;
    RenderScene half = scene;
    half.extinction = Between(scene.base, 0.5, scene.extinction);
    RenderScene nothing = scene;
    nothing.base.clear();
    nothing.extinction.clear();
    Renderer renderer;
    nothing.SetUp(renderer);
    Drawn(renderer, nothing);

    renderer.SetExtinction(scene.changeGrid, scene.base.data(), scene.extinction.data(), 0.5);

    const Picture picture = Drawn(renderer, scene);
    const Picture expected = half.Render();
    double mean = 0;
    for (std::size_t byte = 0; byte < picture.rgba.size(); ++byte)
    {
      mean += std::abs(picture.rgba[byte] - double(expected.rgba[byte])) / 255;
    }
    EXPECT_LE(mean / double(picture.rgba.size()), 1 / 255.0) << (lit ? "lit" : "not lit");
  }
}

TEST(RendererExtinction, ArrivesWhereItIsGoing)
{
  // An easing that ends must end at the picture of the new extinction, not near it.
  const RenderScene scene = Ordinary();
  Renderer renderer;
  scene.SetUp(renderer);
  renderer.SetExtinction(scene.changeGrid, scene.base.data(), scene.base.data());
  for (int frame = 0; frame < 10; ++frame)
  {
    renderer.SetExtinction(scene.changeGrid, scene.base.data(), scene.extinction.data(), 0.3);
  }

  renderer.SetExtinction(scene.changeGrid, scene.base.data(), scene.extinction.data(), 1);

  EXPECT_EQ(Drawn(renderer, scene).rgba, scene.Render().rgba);
}

TEST(RendererExtinction, EasesFromACoarserGridToAFinerOne)
{
  const RenderScene coarse = Cleared();
  RenderScene fine = coarse;
  fine.changeGrid = fine.grid;
  fine.base = Sampled(coarse.changeGrid, coarse.base, fine.grid);
  const std::vector<float> before = Sampled(coarse.changeGrid, coarse.extinction, fine.grid);
  fine.extinction = before;
  std::reverse(fine.extinction.begin(), fine.extinction.end());
  RenderScene half = fine;
  half.extinction = Between(before, 0.5, fine.extinction);
  Renderer renderer;
  coarse.SetUp(renderer);
  Drawn(renderer, coarse);

  renderer.SetExtinction(fine.changeGrid, fine.base.data(), fine.extinction.data(), 0.5);

  ExpectSameButRounding(fine, Drawn(renderer, fine), half.Render(), 3);
}

TEST(RendererExtinction, KeepsItsUnitWhenTheTransferFunctionsMajorantChanges)
{
  RenderScene scene = Ordinary();
  Renderer renderer;
  scene.SetUp(renderer);
  Drawn(renderer, scene);
  // One entry beyond all scalars: the picture's extinction stays, the majorant is twice as large.
  const float majorant =
    *std::max_element(scene.functions.extinction.begin(), scene.functions.extinction.end());
  const double step = 1.0 / 32;
  for (int entry = 0; entry < 32; ++entry)
  {
    scene.functions.extinction.push_back(entry == 31 ? 2 * majorant : 0.0f);
    scene.functions.color.push_back({ { 1, 1, 1 } });
  }
  scene.functions.high += 32 * step;

  renderer.SetTransferFunctions(scene.functions);

  ExpectSameButRounding(scene, Drawn(renderer, scene), scene.Render(), 2);
}

TEST(RendererExtinction, OfNodesWithoutANumberIsZeroAndOthersKeepTheirs)
{
  // Scalars 1 everywhere but in a few empty nodes look like scalars 0 there under a transfer
  // function that is linear, with one colour.
  RenderScene scene = RenderScene::Homogeneous(
    MakeGrid({ 9, 9, 9 }, { -1, -1, -1 }, { 0.25, 0.25, 0.25 }), 2, { { 1, 0.5f, 0 } });
  scene.functions.extinction = { 0.0f, 2.0f };
  std::fill(scene.scalars.begin(), scene.scalars.end(), 1.0f);
  RenderScene zeros = scene;
  for (const int node : { 0, 40, 364, 365, 366, 500, 728 })
  {
    scene.scalars[std::size_t(node)] =
      node % 2 ? notANumber : -std::numeric_limits<float>::infinity();
    zeros.scalars[std::size_t(node)] = 0;
  }

  ExpectSameButRounding(scene, scene.Render(), zeros.Render(), 0);
}

TEST(RendererExtinction, OfNodesWithoutANumberCastsNoShadow)
{
  RenderScene scene = RenderScene::Homogeneous(
    MakeGrid({ 9, 9, 9 }, { -1, -1, -1 }, { 0.25, 0.25, 0.25 }), 2, { { 1, 0.5f, 0 } });
  std::fill(scene.scalars.begin(), scene.scalars.end(), notANumber);
  scene.lighting.enabled = true;
  Renderer renderer;
  scene.SetUp(renderer);

  EXPECT_EQ(renderer.ArrivingLightAt({ 0.3, 0.2, 0.1 }), 1);
}

TEST(RendererExtinction, ForTheLightIsWhatCastsTheShadows)
{
  RenderScene scene = Ordinary();
  scene.lighting.enabled = true;
  std::vector<float> nothing(scene.base.size(), 0.0f);
  Renderer renderer;
  scene.SetUp(renderer);
  renderer.SetExtinction(
    scene.changeGrid, scene.base.data(), scene.extinction.data(), 1, nothing.data());
  const Vec3 inside = scene.grid.PointToWorld({ 6.2, 4.1, 5.7 });

  EXPECT_WITHIN(renderer.ArrivingLightAt(inside), 1, Roundoff<float>(10, 1));
  const Picture unshadowed = Drawn(renderer, scene);
  scene.lighting.shadows = false;
  EXPECT_EQ(unshadowed.rgba, scene.Render().rgba);
}
