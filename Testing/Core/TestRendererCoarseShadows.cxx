// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Shadows on a coarser grid than the extinction's, for pictures that move.

#include "RenderScene.h"
#include "Tolerance.h"

#include "Resampled.h"
#include "math/Require.h"
#include "scene/Resampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using namespace limpid;

namespace
{
RenderScene Shadowed()
{
  RenderScene scene =
    RenderScene::Random(4, MakeGrid({ 13, 11, 9 }, { 3, -1, 2 }, { 0.3, 0.4, 0.5 }), 8);
  scene.lighting.enabled = true;
  return scene;
}

Picture Drawn(Renderer& renderer, const RenderScene& scene)
{
  Picture picture;
  renderer.Render(scene.WholeView(), picture);
  return picture;
}

/// As two renderers have it that are to agree. Both keep the values of coarse nodes and of fine
/// ones between them in 15 bits; the interpolation between four nodes rounds some ten times.
const Tolerance Stored{ 1.5 / 32767, "transmittance is kept in 15 bits" };
}

TEST(RendererCoarseShadows, OfTheTransferFunctionAreThoseOfItsRestrictedExtinction)
{
  RenderScene scene = Shadowed();
  Renderer coarse;
  scene.SetUp(coarse);
  coarse.SetShadowCoarseness(2);

  // The transfer function's extinction at the nodes, as the mapper would give it to an optimiser.
  scene.changeGrid = CoarseGrid(scene.grid, 2);
  std::vector<float> fine;
  for (const float scalar : scene.scalars)
  {
    const float place = 32 * std::min(std::max(scalar, 0.0f), 1.0f);
    const auto entry = static_cast<std::size_t>(std::min(place, 31.0f));
    const float low = scene.functions.extinction[entry];
    const float high = scene.functions.extinction[entry + 1];
    fine.push_back(low + (place - float(entry)) * (high - low));
  }
  scene.base = scene.extinction = Resampled(scene.grid, fine.data(), scene.changeGrid);
  Renderer restricted;
  scene.SetUp(restricted);

  for (const Vec3& index : { Vec3(1.3, 2.2, 3.1), Vec3(6, 4.5, 7), Vec3(11.9, 0.2, 0.3) })
  {
    const Vec3 place = scene.grid.PointToWorld(index);
    EXPECT_WITHIN(coarse.ArrivingLightAt(place), restricted.ArrivingLightAt(place),
      Stored + Roundoff<float>(100, 8.0));
  }
}

TEST(RendererCoarseShadows, OfAGivenExtinctionAreInterpolatedFromTheCoarseGrid)
{
  RenderScene scene = Shadowed();
  scene.Change({ 13, 11, 9 }, 21);
  Renderer coarse;
  scene.SetUp(coarse);
  coarse.SetShadowCoarseness(2);
  RenderScene restricted = scene;
  restricted.changeGrid = CoarseGrid(scene.changeGrid, 2);
  restricted.extinction =
    Resampled(scene.changeGrid, scene.extinction.data(), restricted.changeGrid);
  restricted.base = restricted.extinction;
  Renderer onCoarseGrid;
  restricted.SetUp(onCoarseGrid);

  const Tolerance extinctionStored{ 8 / 32767.0, "so is extinction, and optical depths reach 8" };
  // At the nodes of both grids, and half-way between, where fine nodes are.
  for (const Vec3& index : { Vec3(2, 4, 6), Vec3(3, 5, 7), Vec3(12, 1, 0), Vec3(5, 10, 8) })
  {
    const Vec3 place = scene.grid.PointToWorld(index);
    EXPECT_WITHIN(coarse.ArrivingLightAt(place), onCoarseGrid.ArrivingLightAt(place),
      Stored + extinctionStored);
  }
  // The extinction itself stays fine: without shadows, nothing has changed.
  scene.lighting.shadows = false;
  coarse.SetLighting(scene.lighting);
  EXPECT_EQ(Drawn(coarse, scene).rgba, scene.Render().rgba);
}

TEST(RendererCoarseShadows, LeaveNoTrace)
{
  for (const bool changed : { false, true })
  {
    RenderScene scene = Shadowed();
    if (changed)
    {
      scene.Change({ 7, 5, 6 }, 21);
    }
    Renderer renderer;
    scene.SetUp(renderer);
    renderer.SetShadowCoarseness(3);
    const Picture coarse = Drawn(renderer, scene);

    renderer.SetShadowCoarseness(1);

    EXPECT_EQ(Drawn(renderer, scene).rgba, scene.Render().rgba);
    EXPECT_NE(coarse.rgba, scene.Render().rgba);
  }
}

TEST(RendererCoarseShadows, FollowANewExtinctionAndANewLight)
{
  RenderScene scene = Shadowed();
  scene.Change({ 13, 11, 9 }, 21);
  Renderer renderer;
  scene.SetUp(renderer);
  renderer.SetShadowCoarseness(2);
  Drawn(renderer, scene);
  scene.Change({ 13, 11, 9 }, 5);
  scene.lighting.light.position.x += 3 * scene.grid.Radius();

  renderer.SetExtinction(scene.changeGrid, scene.base.data(), scene.extinction.data());
  renderer.SetLighting(scene.lighting);

  Renderer fresh;
  scene.SetUp(fresh);
  fresh.SetShadowCoarseness(2);
  EXPECT_EQ(Drawn(renderer, scene).rgba, Drawn(fresh, scene).rgba);
}

TEST(RendererCoarseShadows, AreMadeOnce)
{
  const RenderScene scene = Shadowed();
  Renderer renderer;
  EXPECT_FALSE(renderer.UpdateShadows()); // there is nothing yet
  scene.SetUp(renderer);

  EXPECT_TRUE(renderer.UpdateShadows());
  EXPECT_FALSE(renderer.UpdateShadows());
  renderer.SetShadowCoarseness(2);
  EXPECT_TRUE(renderer.UpdateShadows());
  EXPECT_FALSE(renderer.UpdateShadows());
}

TEST(RendererCoarseShadows, DoNotGetFinerThanTheExtinction)
{
  Renderer renderer;
  for (const int factor : { 0, -2 })
  {
    EXPECT_THROW(renderer.SetShadowCoarseness(factor), Error) << factor;
  }
}

TEST(RendererCoarseShadows, AreLeftOfABoxThatIsThinnerThanTheyAreCoarse)
{
  RenderScene scene = RenderScene::Homogeneous(
    MakeGrid({ 25, 2, 2 }, { 3, -1, 2 }, { 0.3, 0.4, 0.5 }), 2, { { 1, 1, 1 } });
  scene.lighting.light.position = scene.grid.Centre() + Vec3(-9, 0.3, -0.2);
  scene.lighting.enabled = true;
  Renderer renderer;
  scene.SetUp(renderer);
  renderer.SetShadowCoarseness(12);

  double darkest = 1;
  for (const int corner : { 0, 1, 2, 3, 4, 5, 6, 7 })
  {
    const Vec3 index(24 * (corner & 1), corner >> 1 & 1, corner >> 2);
    const Vec3 inside = glm::mix(Vec3(12, 0.5, 0.5), index, 0.99);
    const double light = renderer.ArrivingLightAt(scene.grid.PointToWorld(inside));
    EXPECT_TRUE(light >= 0 && light <= 1) << light;
    darkest = std::min(darkest, light);
  }
  EXPECT_LT(darkest, 1);
}

TEST(RendererPrepared, DrawsTheSamePicture)
{
  const RenderScene scene = Shadowed();
  Renderer renderer;
  renderer.Prepare(); // nothing to be prepared
  scene.SetUp(renderer);

  renderer.Prepare();

  EXPECT_EQ(Drawn(renderer, scene).rgba, scene.Render().rgba);
}
