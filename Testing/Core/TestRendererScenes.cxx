// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Seven real scenes: the shadows against the march to the light, and pictures against the
// reference.

#include "LoadedScene.h"
#include "PictureErrors.h"
#include "RenderScene.h"
#include "SceneFunctions.h"
#include "Tolerance.h"

#include "energy/TransmittanceSweep.h"
#include "optimize/Solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
/// A scene file as renderer and reference take it.
struct SceneToDraw
{
  LoadedScene loaded;
  RenderScene drawn;

  explicit SceneToDraw(const std::string& name)
    : loaded(name)
  {
    const truth::SceneFile& file = loaded.file;
    drawn.grid = loaded.grid;
    drawn.scalars.assign(file.scalars.begin(), file.scalars.end());
    drawn.functions = FunctionsOf(file);
    drawn.lighting.enabled = true;
    drawn.lighting.light = loaded.light;
    drawn.view.width = drawn.view.height = 48;
    const double distance = glm::length(loaded.camera.position - loaded.camera.focalPoint);
    drawn.view.clipToWorld =
      Perspective(LookAt(loaded.camera.position, loaded.camera.focalPoint, loaded.camera.viewUp),
        loaded.camera.viewAngle, 1, 0.1 * distance, 3 * distance);
  }

  /// The base extinction of the file on its nodes, or what the solver makes of it.
  void Show(const std::vector<float>& extinction)
  {
    drawn.changeGrid = drawn.grid;
    drawn.base = loaded.file.extinction;
    drawn.extinction = extinction;
  }

  /// The transmittance of the light to the nodes, as pictures have it.
  truth::Field<double> Swept() const
  {
    std::vector<float> transmittance(drawn.extinction.size());
    FillTransmittance(drawn.grid, drawn.extinction.data(),
      SourceOfLight(drawn.lighting.light, drawn.grid), transmittanceRayDensity,
      transmittance.data());
    return TruthOf(drawn.grid, transmittance);
  }

  /// Where what takes light before it reaches a place is no shadow [index].
  Vec3 Before(const Vec3& index) const
  {
    const truth::Illumination light = drawn.Truth().light;
    const truth::Vector place = TruthOf(drawn.grid.PointToWorld(index));
    const truth::Vector before =
      truth::Along(place, -truth::ownCells * light.cell, light.TravelAt(place));
    return drawn.grid.PointToIndex({ before[0], before[1], before[2] });
  }

  truth::Volume<float> Caster() const { return loaded.file.FieldsWith(drawn.extinction); }

  double MarchTo(const Vec3& index) const
  {
    return truth::Transmittance(
      Caster(), TruthOf(drawn.lighting.light), TruthOf(drawn.grid.PointToWorld(index)));
  }
};

/// rms differences of T_L from the march to the light.
struct ShadowErrors
{
  double atNodes = 0;
  double between = 0; ///< at any point
  double ideal = 0;   ///< at the same points, of the interpolation of exact values at the nodes
  double lacking = 0; ///< of the light that arrives in pictures, at nodes: by how much it is less
};

/// Interpolation of marched values at the nodes of a cell.
double IdealShadow(const SceneToDraw& scene, const Vec3& index)
{
  const Int3 cell = glm::min(Int3(index), scene.drawn.grid.nodes - 2);
  const Vec3 share = index - Vec3(cell);
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Int3 side(corner & 1, (corner >> 1) & 1, corner >> 2);
    const Vec3 weight = glm::mix(1.0 - share, share, Vec3(side));
    sum += weight.x * weight.y * weight.z * scene.MarchTo(Vec3(cell + side));
  }
  return sum;
}

ShadowErrors ErrorsOf(SceneToDraw& scene, const std::vector<float>& extinction)
{
  scene.Show(extinction);
  Renderer renderer;
  scene.drawn.SetUp(renderer);
  const Grid& grid = scene.drawn.grid;
  const truth::Field<double> swept = scene.Swept();
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  ShadowErrors squares;
  const int points = 4000;
  for (int point = 0; point < points; ++point)
  {
    const Vec3 share(uniform(generator), uniform(generator), uniform(generator));
    const Vec3 index = share * (Vec3(grid.nodes) - 1.0);
    // Just inside, so that rounding does not put a node of the border outside of the grid.
    const Vec3 node = glm::clamp(glm::round(index), Vec3(1e-6), Vec3(grid.nodes) - 1.0 - 1e-6);
    const double exact = scene.MarchTo(index);
    const auto sweptTo = [&](const Vec3& place)
    {
      const Vec3 last = Vec3(grid.nodes) - 1.0;
      return place == glm::clamp(place, Vec3(0), last) ? swept(TruthOf(grid.PointToWorld(place)))
                                                       : 1.0;
    };
    squares.atNodes += std::pow(sweptTo(glm::round(index)) - scene.MarchTo(glm::round(index)), 2);
    squares.between += std::pow(sweptTo(index) - exact, 2);
    squares.ideal += std::pow(IdealShadow(scene, index) - exact, 2);
    const double arriving = truth::ArrivingLight(sweptTo(node), sweptTo(scene.Before(node)));
    squares.lacking +=
      std::pow(std::max(0.0, arriving - renderer.ArrivingLightAt(grid.PointToWorld(node))), 2);
  }
  return { std::sqrt(squares.atNodes / points), std::sqrt(squares.between / points),
    std::sqrt(squares.ideal / points), std::sqrt(squares.lacking / points) };
}

/// The bar at the nodes; between them, what the interpolation of exact values misses comes on top.
void ExpectShadow(SceneToDraw& scene, const std::vector<float>& extinction, const char* what)
{
  const ShadowErrors errors = ErrorsOf(scene, extinction);
  std::cout << scene.loaded.file.name << ", " << what << ": rms of T_L at nodes " << errors.atNodes
            << ", anywhere " << errors.between << ", of exact nodes " << errors.ideal
            << "; the light that arrives lacks " << errors.lacking << "\n";
  const Tolerance bar{ 2e-3, "the bar for shadows, rms" };
  EXPECT_WITHIN(errors.atNodes, 0, bar) << what;
  EXPECT_WITHIN(errors.between, 0,
    (bar + Tolerance{ errors.ideal, "trilinear interpolation of exact values at the nodes" }))
    << what;
  EXPECT_WITHIN(errors.lacking, 0, bar) << what;
}
}

class DrawnScene : public RealScene
{
};

TEST_P(DrawnScene, IsShadowedAsTheMarchToItsLightSays)
{
  SceneToDraw scene(GetParam().name);

  ExpectShadow(scene, scene.loaded.file.extinction, "base");
}

TEST_P(DrawnScene, IsShadowedAsTheMarchSaysWhenOptimised)
{
  SceneToDraw scene(GetParam().name);
  Solver solver = scene.loaded.MakeSolver();
  solver.Run();

  ExpectShadow(scene, solver.Extinction(), "optimised");
}

TEST_P(DrawnScene, IsShadowedAsTheMarchSaysUnderAHeadlight)
{
  SceneToDraw scene(GetParam().name);
  Light& light = scene.drawn.lighting.light;
  light.type = LightType::Directional;
  light.focalPoint = scene.drawn.grid.Centre();
  light.position = scene.loaded.camera.position;

  ExpectShadow(scene, scene.loaded.file.extinction, "headlight");
}

TEST_P(DrawnScene, IsShadowedAsTheMarchSaysUnderALightAlongAnAxis)
{
  SceneToDraw scene(GetParam().name);
  Light& light = scene.drawn.lighting.light;
  light.type = LightType::Directional;
  light.focalPoint = scene.drawn.grid.Centre();
  light.position = light.focalPoint + Vec3(0, 0, 1);

  ExpectShadow(scene, scene.loaded.file.extinction, "along z");
}

TEST_P(DrawnScene, IsThePictureOfTheReference)
{
  // T_L as the renderer has it: this is about the rays. The bound of each ray is that of second
  // order, to leading order.
  SceneToDraw scene(GetParam().name);
  RenderScene& drawn = scene.drawn;
  drawn.lighting.shadows = false;
  drawn.view.opaqueBelow = 0;
  const truth::PictureMarch march(drawn.Truth(), truth::Shadow::Interpolated, 8);

  const Picture picture = drawn.Render();

  const Comparison comparison = Compare(drawn, picture, march.Picture(drawn.Frame()),
    EightBits() + StoredGradient(drawn.lighting) + StoredMedium(drawn));
  std::cout << scene.loaded.file.name << ": rms error of the picture " << comparison.rms
            << ", mean allowed " << comparison.meanAllowed << ", worst share of it "
            << comparison.worst << "\n";
  EXPECT_LE(comparison.worst, 1) << comparison.where;
}

INSTANTIATE_TEST_SUITE_P(Quick, DrawnScene, ::testing::Values(Bars{ "carotid_mra", 0, 0 }),
  ::testing::PrintToStringParamName());

INSTANTIATE_TEST_SUITE_P(Long, DrawnScene,
  ::testing::Values(Bars{ "isabel_wind", 0, 0 }, Bars{ "visible_male", 0, 0 },
    Bars{ "engine", 0, 0 }, Bars{ "thorax_ct", 0, 0 }, Bars{ "vortex_rings", 0, 0 },
    Bars{ "skull_phantom", 0, 0 }),
  ::testing::PrintToStringParamName());
