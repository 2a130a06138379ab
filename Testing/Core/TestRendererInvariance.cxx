// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What must not change the picture: skipping, threads, repetition, units; and by how much early
// termination and jitter may.

#include "PictureErrors.h"
#include "RenderScene.h"
#include "Tolerance.h"

#include "backend/Backend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

using namespace limpid;

namespace
{
/// Two thirds empty: balls in the air, as wide as a few nodes, in a box with sides that are no
/// multiple of anything.
RenderScene Balls(const Int3& nodes = { 37, 30, 23 })
{
  const Grid grid = MakeGrid(nodes, { -1, 2, 3 }, { 0.5, 0.6, 0.8 });
  RenderScene scene = RenderScene::Random(11, grid, 20);
  std::fill_n(scene.functions.extinction.begin(), 6, 0.0f);
  std::mt19937 generator(5);
  std::fill(scene.scalars.begin(), scene.scalars.end(), 0.0f);
  for (int ball = 0; ball < 12; ++ball)
  {
    Vec3 centre;
    for (int axis = 0; axis < 3; ++axis)
    {
      centre[axis] = generator() % unsigned(nodes[axis]);
    }
    std::size_t node = 0;
    for (int k = 0; k < nodes.z; ++k)
    {
      for (int j = 0; j < nodes.y; ++j)
      {
        for (int i = 0; i < nodes.x; ++i, ++node)
        {
          const double distance = glm::length(Vec3(i, j, k) - centre);
          scene.scalars[node] = std::max(scene.scalars[node], float(1 - 0.25 * distance));
        }
      }
    }
  }
  scene.LookAtBox(RenderScene::Direction(0.9, 1.3, -3), 61);
  return scene;
}

/// Up in some places where nothing was, down in others, on a coarser grid.
void ChangeSomewhere(RenderScene& scene)
{
  scene.Change({ 13, 9, 8 }, 3);
  for (std::size_t node = 0; node < scene.base.size(); ++node)
  {
    if (node % 3 != 0)
    {
      scene.extinction[node] = scene.base[node];
    }
  }
}

int LargestDifference(const Picture& one, const Picture& other)
{
  int largest = 0;
  for (std::size_t byte = 0; byte < one.rgba.size(); ++byte)
  {
    largest = std::max(largest, std::abs(int(one.rgba[byte]) - int(other.rgba[byte])));
  }
  return largest;
}

double MeanAlpha(const Picture& picture)
{
  double sum = 0;
  for (std::size_t pixel = 0; pixel < picture.rgba.size() / 4; ++pixel)
  {
    sum += Channel(picture, pixel, 3);
  }
  return sum / (double(picture.rgba.size()) / 4);
}

struct Look
{
  const char* name;
  Vec3 direction;
};

const Look looks[] = { { "Oblique", { 0.9, 1.3, -3 } }, { "AlongX", { 1, 0, 1e-9 } },
  { "AlongZ", { 1e-9, 0, 1 } }, { "Diagonal", { 1, 1, 1 } }, { "FromBehind", { -2, -1, 1 } } };

std::ostream& operator<<(std::ostream& stream, const Look& look)
{
  return stream << look.name;
}
}

class SkippedEmptiness : public ::testing::TestWithParam<Look>
{
protected:
  void ExpectNoDifference(RenderScene scene)
  {
    scene.LookAtBox(glm::normalize(GetParam().direction), 61);
    for (const double sampleDistance : { 1.0, 0.3, 3.9, 7.0 })
    {
      for (const bool jitter : { false, true })
      {
        scene.view.sampleDistance = sampleDistance;
        scene.view.jitter = jitter;
        scene.view.skipEmpty = true;
        const Picture with = scene.Render();
        scene.view.skipEmpty = false;
        const Picture without = scene.Render();

        EXPECT_EQ(with.rgba, without.rgba)
          << "sample distance " << sampleDistance << ", jitter " << jitter << ": up to "
          << LargestDifference(with, without) << "/255";
        EXPECT_GT(MeanAlpha(without), 0.05);
      }
    }
  }
};

TEST_P(SkippedEmptiness, DoesNotChangeABit)
{
  ExpectNoDifference(Balls());
}

TEST_P(SkippedEmptiness, DoesNotChangeABitOfAChangedMedium)
{
  RenderScene scene = Balls();
  ChangeSomewhere(scene);

  ExpectNoDifference(scene);
}

TEST_P(SkippedEmptiness, DoesNotChangeABitOfALitPicture)
{
  RenderScene scene = Balls();
  ChangeSomewhere(scene);
  scene.lighting.enabled = true;

  ExpectNoDifference(scene);
}

TEST_P(SkippedEmptiness, DoesNotChangeABitFromInside)
{
  RenderScene scene = Balls();
  const Vec3 eye = scene.grid.Centre();
  const glm::dmat4 inside =
    Perspective(LookAt(eye, eye + GetParam().direction, Vec3(0.1, 0.9, 0.2)), 90, 1, 1e-3, 100);
  scene.view.clipToWorld = inside;
  const Picture with = scene.Render();
  scene.view.skipEmpty = false;

  EXPECT_EQ(with.rgba, scene.Render().rgba);
}

// Rays that never leave the depth of the volume, and rays that are all the same.
TEST_P(SkippedEmptiness, DoesNotChangeABitAtAnyAngle)
{
  for (const double angle : { 1e-6, 179.9, 179.999999 })
  {
    SCOPED_TRACE(angle);
    RenderScene scene = Balls();
    const Vec3 centre = scene.grid.Centre();
    const Vec3 eye = centre - 2 * scene.grid.Radius() * glm::normalize(GetParam().direction);
    scene.view.clipToWorld =
      Perspective(LookAt(eye, centre, Vec3(0.1, 0.9, 0.2)), angle, 1, 1e-3, 100);
    const Picture with = scene.Render();
    scene.view.skipEmpty = false;

    EXPECT_EQ(with.rgba, scene.Render().rgba);
  }
}

TEST_P(SkippedEmptiness, DoesNotChangeABitOfAThinFeatureOfTheTransferFunction)
{
  // Extinction in one entry of a thousand: between two nodes, not at any.
  RenderScene scene = Balls();
  scene.functions.extinction.assign(1001, 0.0f);
  scene.functions.color.assign(1001, { { 1, 0.5f, 0 } });
  scene.functions.extinction[333] = 300;

  ExpectNoDifference(scene);
}

// Where all scalars have the same extinction, emptiness is in the nodes.
TEST_P(SkippedEmptiness, DoesNotChangeABitOfEmptyNodesInOneExtinction)
{
  RenderScene scene = Balls();
  for (float& scalar : scene.scalars)
  {
    scalar = scalar < 0.2f ? std::numeric_limits<float>::quiet_NaN() : scalar;
  }
  std::fill(scene.functions.extinction.begin(), scene.functions.extinction.end(), 2.0f);
  ExpectNoDifference(scene);

  ChangeSomewhere(scene);
  scene.lighting.enabled = true;
  ExpectNoDifference(scene);
}

INSTANTIATE_TEST_SUITE_P(
  Views, SkippedEmptiness, ::testing::ValuesIn(looks), ::testing::PrintToStringParamName());

TEST(RendererInvariance, ThreadsDoNotChangeABit)
{
  RenderScene scene = Balls();
  ChangeSomewhere(scene);
  scene.lighting.enabled = true;
  std::vector<Picture> pictures;
  for (const int threads : { 1, 2, 3 })
  {
    const ThreadLimit limit(threads);
    pictures.push_back(scene.Render());
  }

  EXPECT_EQ(pictures[0].rgba, pictures[1].rgba);
  EXPECT_EQ(pictures[0].rgba, pictures[2].rgba);
}

namespace
{
/// Integers give the picture of the same floats, with light and a change.
template <class Integer>
void ExpectPictureOfFloats(double scale)
{
  RenderScene scene = Balls();
  scene.lighting.enabled = true;
  ChangeSomewhere(scene);
  std::vector<Integer> integers;
  for (float& scalar : scene.scalars)
  {
    scalar = std::round(float(scale) * std::min(std::max(scalar, 0.0f), 1.0f));
    integers.push_back(Integer(scalar));
  }
  scene.functions.low *= scale;
  scene.functions.high *= scale;
  const Picture expected = scene.Render();
  Renderer renderer;
  scene.SetUp(renderer);
  renderer.SetScalars(scene.grid, ScalarNodes(integers.data()));
  renderer.SetTransferFunctions(scene.functions);
  renderer.SetExtinction(scene.changeGrid, scene.base.data(), scene.extinction.data());
  Picture picture;
  renderer.Render(scene.view, picture);
  EXPECT_EQ(picture.rgba, expected.rgba);
}
}

TEST(RendererInvariance, IntegersAreDrawnAsTheSameFloats)
{
  ExpectPictureOfFloats<std::int8_t>(127);
  ExpectPictureOfFloats<std::uint8_t>(255);
  ExpectPictureOfFloats<std::int16_t>(32767);
  ExpectPictureOfFloats<std::uint16_t>(65535);
}

TEST(RendererInvariance, WhatWasDrawnBeforeDoesNotChangeABit)
{
  RenderScene scene = Balls();
  scene.lighting.enabled = true;
  const Picture fresh = scene.Render();
  RenderScene other = Balls({ 20, 33, 18 });
  ChangeSomewhere(other);
  other.lighting.enabled = true;
  other.lighting.light.position = { 100, 0, 0 };
  Renderer renderer;
  Picture picture;
  other.SetUp(renderer);
  renderer.Render(other.view, picture);
  renderer.SetScalars(scene.grid, scene.scalars.data());
  renderer.SetTransferFunctions(scene.functions);
  renderer.SetExtinction(scene.grid, nullptr, nullptr);
  renderer.SetLighting(scene.lighting);

  renderer.Render(scene.view, picture);

  EXPECT_EQ(picture.rgba, fresh.rgba);
}

TEST(RendererInvariance, NewScalarsCastNewShadows)
{
  RenderScene before = Balls();
  before.lighting.enabled = true;
  RenderScene after = before;
  std::reverse(after.scalars.begin(), after.scalars.end());
  Renderer renderer;
  Picture picture;
  before.SetUp(renderer);
  renderer.Render(before.view, picture);
  const std::vector<std::uint8_t> old = picture.rgba;

  renderer.SetScalars(after.grid, after.scalars.data());
  renderer.Render(after.view, picture);

  EXPECT_NE(picture.rgba, old);
  EXPECT_EQ(picture.rgba, after.Render().rgba);
}

TEST(RendererInvariance, ANewTransferFunctionCastsNewShadows)
{
  RenderScene before = Balls();
  before.lighting.enabled = true;
  RenderScene after = before;
  for (float& value : after.functions.extinction)
  {
    value *= 0.2f;
  }
  Renderer renderer;
  Picture picture;
  before.SetUp(renderer);
  renderer.Render(before.view, picture);

  renderer.SetTransferFunctions(after.functions);
  renderer.Render(after.view, picture);

  EXPECT_EQ(picture.rgba, after.Render().rgba);
}

TEST(RendererInvariance, LightSwitchedOffAndOnAgainIsTheSame)
{
  RenderScene scene = Balls();
  const Picture unlit = scene.Render();
  scene.lighting.enabled = true;
  const Picture lit = scene.Render();
  Renderer renderer;
  Picture picture;
  scene.SetUp(renderer);
  renderer.Render(scene.view, picture);
  EXPECT_EQ(picture.rgba, lit.rgba);

  Lighting off = scene.lighting;
  off.enabled = false;
  renderer.SetLighting(off);
  renderer.Render(scene.view, picture);
  EXPECT_EQ(picture.rgba, unlit.rgba);

  renderer.SetLighting(scene.lighting);
  renderer.Render(scene.view, picture);
  EXPECT_EQ(picture.rgba, lit.rgba);
}

TEST(RendererInvariance, UnitsAndPlaceDoNotMatter)
{
  RenderScene scene = Balls();
  scene.lighting.enabled = true;
  const Picture here = scene.Render();
  for (const double unit : { 1e-9, 1e9 })
  {
    RenderScene other = Balls();
    const Vec3 shift = unit * Vec3(1e4, -2e4, 5e3);
    other.grid.origin = unit * scene.grid.origin + shift;
    other.grid.spacing = unit * scene.grid.spacing;
    for (float& value : other.functions.extinction)
    {
      value = float(value / unit);
    }
    other.lighting = scene.lighting;
    other.lighting.light.position = unit * scene.lighting.light.position + shift;
    other.LookAtBox(RenderScene::Direction(0.9, 1.3, -3), 61);

    // Rounding moves rays and the ends of segments a little: a value on the edge between two.
    EXPECT_LE(LargestDifference(other.Render(), here), 1) << "unit " << unit;
  }
}

TEST(RendererInvariance, EarlyTerminationCostsNoMoreThanItsBound)
{
  RenderScene scene = Balls();
  scene.lighting.enabled = true;
  scene.view.opaqueBelow = 0;
  const Picture whole = scene.Render();
  for (const double opaqueBelow : { 1 / 1024.0, 0.02, 0.3 })
  {
    scene.view.opaqueBelow = opaqueBelow;
    const Picture early = scene.Render();

    // What is left out is seen through less than opaqueBelow: white, as bright as 1.6 times the
    // ambient and direct light here at most, and one unit of rounding.
    const double bound = 255 * opaqueBelow * 1.6 + 1;
    EXPECT_LE(LargestDifference(early, whole), bound) << opaqueBelow;
  }
}

TEST(RendererInvariance, TwoPartsOfRaysThatMeetWhereItIsEmptyAreTheWhole)
{
  // Above the middle and below, with a gap wider than a segment between: every segment is that of
  // the whole ray, however long.
  RenderScene scene = Balls({ 37, 30, 43 });
  const Index slice = Index(37) * 30;
  std::fill(scene.scalars.begin() + 17 * slice, scene.scalars.begin() + 26 * slice, 0.0f);
  for (const Index first : { 6 * slice + 37 * 10, 32 * slice + 37 * 12 }) // something in both
  {
    std::fill_n(scene.scalars.begin() + first, 37 * 8, 0.7f);
  }
  scene.lighting.enabled = true;
  scene.view.opaqueBelow = 0;
  scene.view.jitter = true;
  scene.view.clipToWorld =
    Parallel(LookAt(scene.grid.Centre() - Vec3(0, 0, 3 * scene.grid.Radius()), scene.grid.Centre(),
               { 0, 1, 0 }),
      scene.grid.Radius(), 1, scene.grid.Radius(), 5 * scene.grid.Radius());
  for (const double sampleDistance : { 0.7, 1.0, 2.3 })
  {
    scene.view.sampleDistance = sampleDistance;
    scene.nearDepth.clear();
    scene.depth.clear();
    const Picture whole = scene.Render();
    // The middle of the box is in the middle of the clipping range.
    scene.depth.assign(std::size_t(scene.view.width) * std::size_t(scene.view.height), 0.0f);
    const Picture front = scene.Render();
    scene.nearDepth = scene.depth;
    scene.depth.clear();
    const Picture back = scene.Render();

    double worst = 0;
    for (std::size_t i = 0; i < whole.rgba.size(); ++i)
    {
      const double through = 1 - front.rgba[i / 4 * 4 + 3] / 255.0;
      const double both = std::min(255.0, front.rgba[i] + through * back.rgba[i]);
      worst = std::max(worst, std::abs(both - whole.rgba[i]));
    }
    EXPECT_LE(worst, 2) << sampleDistance; // four numbers that are rounded by half
    EXPECT_GT(MeanAlpha(front), 0.01);
    EXPECT_GT(MeanAlpha(back), 0.01);
  }
}

TEST(RendererInvariance, JitterIsDeterministic)
{
  RenderScene scene = Balls();
  scene.view.jitter = true;
  scene.view.sampleDistance = 2;
  const Picture once = scene.Render();
  scene.view.jitter = false;

  RenderScene again = Balls();
  again.view.jitter = true;
  again.view.sampleDistance = 2;
  EXPECT_EQ(again.Render().rgba, once.rgba);
  EXPECT_NE(scene.Render().rgba, once.rgba);
}

TEST(RendererInvariance, JitterIsUnbiased)
{
  // A wall thinner than the distance between samples, across all rays of a parallel view: without
  // jitter all rays miss it by the same amount, with jitter their mean is right. Linear in the
  // scalar and faint, so that the mean of the alphas is the alpha of the mean.
  RenderScene scene = RenderScene::Homogeneous(
    MakeGrid({ 5, 5, 41 }, { -1, -1, -1 }, { 0.5, 0.5, 0.05 }), 1, { { 1, 1, 1 } });
  scene.functions.extinction = { 0.0f, 1.0f };
  std::fill(scene.scalars.begin(), scene.scalars.end(), 0.0f);
  std::fill_n(scene.scalars.begin() + 25 * 18, 25, 1.0f); // the nodes of one slice
  scene.view.width = scene.view.height = 200;
  scene.view.clipToWorld = Parallel(LookAt({ 0, 0, -5 }, { 0, 0, 0 }, { 0, 1, 0 }), 0.99, 1, 1, 10);
  scene.view.sampleDistance = 7.3;
  const double exact = -std::expm1(-0.05);

  const double rigid = MeanAlpha(scene.Render());
  scene.view.jitter = true;
  const double jittered = MeanAlpha(scene.Render());

  // A ray sees the wall with probability 1 / 7.3 or, within the two neighbouring segments, parts
  // of it: its alpha is at most 7.3 times the exact one, so the mean of 40000 rays is uncertain by
  // sqrt(7.3 / 40000); three times that. The alpha of 7.3 x 0.05 is 17 % less than linear.
  const Tolerance tolerance =
    Relative(3 * std::sqrt(7.3 / 40000), exact, "three standard deviations of 40000 rays") +
    Relative(0.17, exact, "alpha is not linear in optical depth");
  EXPECT_WITHIN(jittered, exact, tolerance);
  EXPECT_GT(std::abs(rigid - exact), 0.5 * exact) << "the wall was not missed";
}
