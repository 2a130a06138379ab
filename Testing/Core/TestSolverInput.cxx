// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Scenes and settings that cannot be worked with: a message that says what, why and what to do,
// with the offending value.

#include "BoxScene.h"

#include "math/Require.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

using namespace limpid;

namespace
{
const double notANumber = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

/// What the solver says to the onion after `change`; empty if it says nothing.
std::string MessageAfter(const std::function<void(BoxScene&)>& change)
{
  BoxScene scene = BoxScene::Cube(5);
  scene.FillOnion();
  change(scene);
  try
  {
    scene.MakeSolver().Run();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "";
}

/// "What is wrong (why it matters). What to do." with the value.
void ExpectMessage(const std::function<void(BoxScene&)>& change, const std::string& value)
{
  const std::string message = MessageAfter(change);
  EXPECT_NE(message.find(value), std::string::npos) << message << "\nlacks " << value;
  const std::size_t why = message.find(" (");
  const std::size_t what = message.find("). ");
  EXPECT_TRUE(
    why != std::string::npos && what != std::string::npos && why < what && message.back() == '.')
    << "\"" << message << "\" is not: what is wrong (why it matters). What to do.";
}
}

TEST(SolverInput, RejectsNegativeWeights)
{
  ExpectMessage([](BoxScene& s) { s.settings.weights.view = -3; }, "-3");
  ExpectMessage([](BoxScene& s) { s.settings.weights.light = -4; }, "-4");
  ExpectMessage([](BoxScene& s) { s.settings.weights.regularization = -5; }, "-5");
}

TEST(SolverInput, RejectsWeightsThatAreNoNumbers)
{
  ExpectMessage([](BoxScene& s) { s.settings.weights.view = notANumber; }, "nan");
  ExpectMessage([](BoxScene& s) { s.settings.weights.light = infinity; }, "inf");
}

TEST(SolverInput, RejectsSettingsOutOfRange)
{
  ExpectMessage([](BoxScene& s) { s.settings.rayDensity = 0; }, " 0");
  ExpectMessage([](BoxScene& s) { s.settings.rayDensity = -1; }, "-1");
  ExpectMessage([](BoxScene& s) { s.settings.rayDensity = notANumber; }, "nan");
  ExpectMessage([](BoxScene& s) { s.settings.tolerance = -0.5; }, "-0.5");
  ExpectMessage([](BoxScene& s) { s.settings.maximumSeconds = -2; }, "-2");
  ExpectMessage([](BoxScene& s) { s.settings.maximumIterations = -7; }, "-7");
  ExpectMessage([](BoxScene& s) { s.settings.learningRate = 0; }, " 0");
  ExpectMessage([](BoxScene& s) { s.settings.iterationsPerLevel[1] = -8; }, "-8");
}

TEST(SolverInput, RejectsACameraThatLooksNowhere)
{
  ExpectMessage([](BoxScene& s) { s.camera.focalPoint = s.camera.position = Vec3(7, 0, 0); }, "7");
  ExpectMessage([](BoxScene& s) { s.camera.position.x = notANumber; }, "nan");
  ExpectMessage([](BoxScene& s) { s.camera.focalPoint.y = infinity; }, "inf");
  ExpectMessage([](BoxScene& s) { s.camera.viewAngle = 180; }, "180");
  ExpectMessage([](BoxScene& s) { s.camera.viewAngle = 0; }, " 0");
  ExpectMessage(
    [](BoxScene& s)
    {
      s.camera.parallel = true;
      s.camera.parallelScale = 0;
    },
    " 0");
  ExpectMessage([](BoxScene& s) { s.camera.aspect = -1; }, "-1");
}

TEST(SolverInput, RejectsALightThatShinesNowhere)
{
  ExpectMessage(
    [](BoxScene& s)
    {
      s.light.type = LightType::Directional;
      s.light.position = s.light.focalPoint = Vec3(9, 0, 0);
    },
    "9");
  ExpectMessage([](BoxScene& s) { s.light.position.z = notANumber; }, "nan");
}

TEST(SolverInput, RejectsFieldsOutOfRange)
{
  ExpectMessage([](BoxScene& s) { s.extinction[17] = -2; }, "-2");
  ExpectMessage([](BoxScene& s) { s.extinction[17] = float(notANumber); }, "nan");
  ExpectMessage([](BoxScene& s) { s.extinction[17] = float(infinity); }, "inf");
  ExpectMessage([](BoxScene& s) { s.importance[17] = 1.5f; }, "1.5");
  ExpectMessage([](BoxScene& s) { s.importance[17] = -0.5f; }, "-0.5");
  ExpectMessage([](BoxScene& s) { s.importance[17] = float(notANumber); }, "nan");
}

TEST(SolverInput, NamesTheVoxelThatIsOutOfRange)
{
  const std::string message = MessageAfter([](BoxScene& s) { s.importance[17] = 1.5f; });

  EXPECT_NE(message.find("17"), std::string::npos) << message;
}

TEST(SolverInput, RejectsImagesWithoutPointsSpacingOrPlace)
{
  ExpectMessage([](BoxScene& s) { s.grid.nodes.y = 0; }, " 0 ");
  ExpectMessage([](BoxScene& s) { s.grid.spacing.z = 0; }, " 0");
  ExpectMessage([](BoxScene& s) { s.grid.spacing.z = -1; }, "-1");
  ExpectMessage([](BoxScene& s) { s.grid.spacing.x = notANumber; }, "nan");
  ExpectMessage([](BoxScene& s) { s.grid.spacing.x = 1e300; }, "1e+300");
  ExpectMessage([](BoxScene& s) { s.grid.spacing.y = 1e-38; }, "1e-38");
  ExpectMessage([](BoxScene& s) { s.grid.origin.x = infinity; }, "inf");
  ExpectMessage([](BoxScene& s) { s.grid.direction[0] = Vec3(1, 0.5, 0); }, "0.5");
}

TEST(SolverInput, RejectsMissingArrays)
{
  const BoxScene scene = BoxScene::Cube(5);
  SceneFields fields = scene.Fields();
  fields.importance = nullptr;

  EXPECT_THROW(Solver(fields, scene.camera, scene.light, scene.settings), Error);
  fields = scene.Fields();
  fields.baseExtinction = nullptr;
  EXPECT_THROW(Solver(fields, scene.camera, scene.light, scene.settings), Error);
}

TEST(SolverInput, RefusesCudaWhereThereIsNone)
{
  if (FindCuda().usable)
  {
    GTEST_SKIP() << "this machine has a GPU";
  }
  ExpectMessage([](BoxScene& s) { s.settings.backend = BackendKind::Cuda; }, "CUDA");
}

TEST(SolverInput, AcceptsTheOrdinaryScene)
{
  EXPECT_EQ(MessageAfter([](BoxScene&) {}), "");
}
