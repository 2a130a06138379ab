// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Pictures of small scenes against the reference: every pixel within what a rule of second order
// may miss on its ray, and second order it is.

#include "PictureErrors.h"
#include "RenderScene.h"
#include "Tolerance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace limpid;
using truth::PictureMarch;
using truth::Shadow;

namespace
{
const int fineSteps = 32;

/// The light that arrives at the nodes as the renderer has it: what is tested here is what the rays
/// make of it.
void TakeShadow(const RenderScene& scene, truth::Medium& medium)
{
  Renderer renderer;
  scene.SetUp(renderer);
  const Grid& grid = scene.extinction.empty() ? scene.grid : scene.changeGrid;
  medium.arrivingLight.lattice = TruthOf(grid);
  truth::ForEachNode(medium.arrivingLight.lattice,
    [&](int i, int j, int k)
    {
      // Just inside, so that rounding does not put a node of the border outside of the grid.
      const Vec3 inside = glm::clamp(Vec3(i, j, k), Vec3(1e-6), Vec3(grid.nodes) - 1.0 - 1e-6);
      medium.arrivingLight.values.push_back(renderer.ArrivingLightAt(grid.PointToWorld(inside)));
    });
}

std::vector<truth::Color> TruthOf(const RenderScene& scene)
{
  truth::Medium medium = scene.Truth();
  if (scene.lighting.enabled && scene.lighting.shadows)
  {
    TakeShadow(scene, medium);
  }
  return PictureMarch(medium, Shadow::Interpolated, fineSteps).Picture(scene.Frame());
}

Tolerance Stored(const RenderScene& scene)
{
  return EightBits() + StoredGradient(scene.lighting) + StoredMedium(scene);
}

void ExpectTruth(const RenderScene& scene)
{
  ExpectPicture(scene, scene.Render(), TruthOf(scene), Stored(scene));
}

/// Anisotropic, off the origin, turned.
Grid TurnedGrid()
{
  Grid grid = MakeGrid({ 13, 10, 8 }, { 5, -3, 20 }, { 0.7, 1.0, 1.4 });
  grid.direction = Mat3(Vec3(0, 0.6, 0.8), Vec3(-1, 0, 0), Vec3(0, -0.8, 0.6));
  return grid;
}

RenderScene RandomScene(unsigned seed)
{
  return RenderScene::Random(seed, TurnedGrid(), 6);
}
}

class RandomPicture : public ::testing::TestWithParam<unsigned>
{
};

TEST_P(RandomPicture, UnlitIsTheIntegralOfEmissionAndAbsorption)
{
  ExpectTruth(RandomScene(GetParam()));
}

TEST_P(RandomPicture, ChangedIsTheIntegralWithTheChangedExtinction)
{
  RenderScene scene = RandomScene(GetParam());
  scene.Change({ 13, 10, 8 }, GetParam() + 100);

  ExpectTruth(scene);
}

TEST_P(RandomPicture, ChangedOnACoarserGridIsTheIntegralWithItsInterpolation)
{
  RenderScene scene = RandomScene(GetParam());
  scene.Change({ 5, 4, 4 }, GetParam() + 100);

  ExpectTruth(scene);
}

TEST_P(RandomPicture, LitWithoutShadowsIsTheIntegralOfScatteredLight)
{
  RenderScene scene = RandomScene(GetParam());
  scene.lighting.enabled = true;
  scene.lighting.shadows = false;

  ExpectTruth(scene);
}

TEST_P(RandomPicture, LitWithShadowsIsTheIntegralOfScatteredLight)
{
  RenderScene scene = RandomScene(GetParam());
  scene.lighting.enabled = true;
  scene.lighting.shadowStrength = 0.9;

  ExpectTruth(scene);
}

TEST_P(RandomPicture, LitAndChangedFromFarAwayIsTheIntegralOfScatteredLight)
{
  RenderScene scene = RandomScene(GetParam());
  scene.Change({ 7, 10, 8 }, GetParam() + 100);
  scene.lighting.enabled = true;
  scene.lighting.light.type = LightType::Directional;
  scene.lighting.surface = 0.7;
  scene.lighting.anisotropy = -0.4;
  scene.lighting.ambient = 0.1;

  ExpectTruth(scene);
}

INSTANTIATE_TEST_SUITE_P(
  Seeds, RandomPicture, ::testing::Values(1u, 2u, 3u, 4u), ::testing::PrintToStringParamName());

TEST(RendererPicture, StaysWithinTheBoundAtAnySampleDistance)
{
  for (const double sampleDistance : { 0.125, 0.25, 0.5, 2.0, 4.0 })
  {
    // The bound is one of leading order: a segment has the optical depth 1 at most.
    RenderScene scene = RandomScene(7);
    const double depth = scene.grid.Radius() / (sampleDistance * scene.SmallestSpacing());
    scene = RenderScene::Random(7, TurnedGrid(), std::min(60.0, depth));
    scene.lighting.enabled = true;
    scene.view.sampleDistance = sampleDistance;
    scene.view.opaqueBelow = 0;

    SCOPED_TRACE(sampleDistance);
    ExpectTruth(scene);
  }
}

TEST(RendererPicture, ConvergesWithTheSquareOfTheSampleDistance)
{
  // Smooth transfer functions: a feature between two samples is not what this is about.
  RenderScene scene = RenderScene::Random(5, TurnedGrid(), 8);
  for (std::size_t entry = 0; entry < scene.functions.extinction.size(); ++entry)
  {
    const double s = double(entry) / 32;
    const double height = std::pow(std::sin(3 * s), 2);
    scene.functions.extinction[entry] = float(height * 8 / scene.grid.Radius());
    scene.functions.color[entry] = { { float(s), float(1 - s), float(height) } };
  }
  scene.lighting.enabled = true;
  scene.view.opaqueBelow = 0;
  const std::vector<truth::Color> truth = TruthOf(scene);
  std::vector<double> errors;
  for (const double sampleDistance : { 2.0, 1.0, 0.5 })
  {
    scene.view.sampleDistance = sampleDistance;
    const Comparison comparison = Compare(scene, scene.Render(), truth, Stored(scene));
    // Less that of rounding, whose square is (1/255)^2 / 12.
    errors.push_back(
      std::sqrt(std::max(0.0, std::pow(comparison.rms, 2) - std::pow(1 / 255.0, 2) / 12)));
  }

  // Four at each halving in the limit; a rule of first order has two.
  EXPECT_GE(errors[0] / errors[1], 3) << errors[0] << " " << errors[1];
  EXPECT_GE(errors[1] / errors[2], 3) << errors[1] << " " << errors[2];
}

TEST(RendererPicture, WithItsOwnShadowsIsNearTheOneWithMarchedShadows)
{
  RenderScene scene = RenderScene::Random(6, TurnedGrid(), 6);
  scene.lighting.enabled = true;
  const PictureMarch march(scene.Truth(), Shadow::Interpolated, fineSteps);

  const Comparison comparison =
    Compare(scene, scene.Render(), march.Picture(scene.Frame()), Stored(scene));

  // T_L to 2e-3 rms is the bar; what it lights is at most as bright as a few times its colour.
  EXPECT_LE(comparison.rms, 4 * 2e-3 + comparison.meanAllowed) << comparison.where;
}
