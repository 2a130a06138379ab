// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What cannot be drawn: a message that says what, why and what to do, with the offending value;
// what is merely empty: an empty picture.

#include "PictureErrors.h"
#include "RenderScene.h"

#include "math/Require.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
const double notANumber = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

RenderScene Ordinary()
{
  RenderScene scene =
    RenderScene::Random(2, MakeGrid({ 9, 9, 9 }, { -1, -1, -1 }, { 0.25, 0.25, 0.25 }), 5);
  scene.lighting.enabled = true;
  return scene;
}

/// What the renderer says to the ordinary scene after `change`; empty if it says nothing.
std::string MessageAfter(const std::function<void(RenderScene&)>& change)
{
  RenderScene scene = Ordinary();
  change(scene);
  try
  {
    scene.Render();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "";
}

void ExpectSentences(const std::string& message)
{
  const std::size_t why = message.find(" (");
  const std::size_t what = message.find("). ");
  EXPECT_TRUE(
    why != std::string::npos && what != std::string::npos && why < what && message.back() == '.')
    << "\"" << message << "\" is not: what is wrong (why it matters). What to do.";
}

/// "What is wrong (why it matters). What to do." with the value.
void ExpectMessage(const std::function<void(RenderScene&)>& change, const std::string& value)
{
  const std::string message = MessageAfter(change);
  if (message.empty())
  {
    ADD_FAILURE() << "no message about " << value;
    return;
  }
  EXPECT_NE(message.find(value), std::string::npos) << "\"" << message << "\" lacks " << value;
  ExpectSentences(message);
}

bool IsEmpty(const Picture& picture)
{
  return std::all_of(picture.rgba.begin(), picture.rgba.end(), [](int byte) { return byte == 0; });
}
}

TEST(RendererInput, AcceptsTheOrdinaryScene)
{
  EXPECT_EQ(MessageAfter([](RenderScene&) {}), "");
}

TEST(RendererInput, NeedsScalarsAndTransferFunctions)
{
  const RenderScene scene = Ordinary();
  Picture picture;
  Renderer empty;
  EXPECT_THROW(empty.Render(scene.view, picture), Error);
  Renderer onlyScalars;
  onlyScalars.SetScalars(scene.grid, scene.scalars.data());
  EXPECT_THROW(onlyScalars.Render(scene.view, picture), Error);
  Renderer onlyFunctions;
  onlyFunctions.SetTransferFunctions(scene.functions);
  EXPECT_THROW(onlyFunctions.Render(scene.view, picture), Error);
  EXPECT_THROW(onlyFunctions.SetScalars(scene.grid, nullptr), Error);
}

TEST(RendererInput, HasNoShadowBeforeThereIsAScene)
{
  Renderer renderer;
  Lighting lighting;
  lighting.enabled = true;
  renderer.SetLighting(lighting);

  EXPECT_EQ(renderer.ArrivingLightAt(Vec3(0)), 1);
}

TEST(RendererInput, DrawsAnEmptyPictureWithoutPixels)
{
  for (const auto& [width, height] :
    { std::make_pair(0, 0), std::make_pair(0, 7), std::make_pair(7, 0) })
  {
    RenderScene scene = Ordinary();
    scene.view.width = width;
    scene.view.height = height;

    const Picture picture = scene.Render();

    EXPECT_TRUE(picture.rgba.empty());
    EXPECT_EQ(picture.width, width);
    EXPECT_EQ(picture.height, height);
  }
}

TEST(RendererInput, RejectsMatricesThatAreSingularOrNoNumbers)
{
  ExpectMessage([](RenderScene& s) { s.view.clipToWorld = glm::dmat4(0.0); }, "singular");
  ExpectMessage([](RenderScene& s) { s.view.clipToWorld[0] = glm::dvec4(0.0); }, "singular");
  ExpectMessage([](RenderScene& s) { s.view.clipToWorld[1][2] = notANumber; }, "finite");
  ExpectMessage([](RenderScene& s) { s.view.clipToWorld[3][3] = infinity; }, "finite");
}

TEST(RendererInput, RejectsMorePlanesThanRaysAreCutBy)
{
  const auto set = [](int count)
  {
    return [count](RenderScene& s)
    { s.view.planes.assign(std::size_t(count), glm::dvec4(0, 0, 0, 1)); };
  };
  EXPECT_EQ(MessageAfter(set(16)), "");
  ExpectMessage(set(17), "17");
}

TEST(RendererInput, RejectsSampleDistancesThatDoNotAdvance)
{
  ExpectMessage([](RenderScene& s) { s.view.sampleDistance = 0; }, " 0");
  ExpectMessage([](RenderScene& s) { s.view.sampleDistance = -2; }, "-2");
  ExpectMessage([](RenderScene& s) { s.view.sampleDistance = notANumber; }, "nan");
  ExpectMessage([](RenderScene& s) { s.view.sampleDistance = infinity; }, "inf");
}

TEST(RendererInput, RejectsAThresholdThatIsNoTransmittance)
{
  ExpectMessage([](RenderScene& s) { s.view.opaqueBelow = notANumber; }, "nan");
  ExpectMessage([](RenderScene& s) { s.view.opaqueBelow = 1.5; }, "1.5");
  ExpectMessage([](RenderScene& s) { s.view.opaqueBelow = -3; }, "-3");
}

TEST(RendererInput, RejectsTransferFunctionsOutOfRange)
{
  ExpectMessage([](RenderScene& s) { s.functions.extinction[3] = -2; }, "-2");
  ExpectMessage([](RenderScene& s) { s.functions.extinction[3] = float(notANumber); }, "nan");
  ExpectMessage([](RenderScene& s) { s.functions.extinction[3] = float(infinity); }, "inf");
  ExpectMessage([](RenderScene& s) { s.functions.color[3][1] = float(notANumber); }, "nan");
  ExpectMessage([](RenderScene& s) { s.functions.color[3][1] = float(infinity); }, "inf");
  ExpectMessage([](RenderScene& s) { s.functions.color.pop_back(); }, "32");
  ExpectMessage([](RenderScene& s) { s.functions.extinction.resize(1); }, " 1 ");
  ExpectMessage([](RenderScene& s) { s.functions.high = s.functions.low; }, " 0");
  ExpectMessage([](RenderScene& s) { s.functions.high = notANumber; }, "nan");
  ExpectMessage([](RenderScene& s) { s.functions.low = -infinity; }, "inf");
}

TEST(RendererInput, RejectsLightingOutOfRange)
{
  ExpectMessage([](RenderScene& s) { s.lighting.anisotropy = 1; }, " 1");
  ExpectMessage([](RenderScene& s) { s.lighting.anisotropy = notANumber; }, "nan");
  ExpectMessage([](RenderScene& s) { s.lighting.intensity = -4; }, "-4");
  ExpectMessage([](RenderScene& s) { s.lighting.ambient = 1.5; }, "1.5");
  ExpectMessage([](RenderScene& s) { s.lighting.ambient = notANumber; }, "nan");
  ExpectMessage([](RenderScene& s) { s.lighting.surface = infinity; }, "inf");
  ExpectMessage([](RenderScene& s) { s.lighting.specularPower = -1; }, "-1");
  ExpectMessage([](RenderScene& s) { s.lighting.shadowStrength = 2; }, " 2");
}

TEST(RendererInput, RejectsALightThatShinesNowhereWithAndWithoutShadows)
{
  for (const bool shadows : { true, false })
  {
    SCOPED_TRACE(shadows);
    ExpectMessage(
      [&](RenderScene& s)
      {
        s.lighting.shadows = shadows;
        s.lighting.light.type = LightType::Directional;
        s.lighting.light.position = s.lighting.light.focalPoint = Vec3(9, 0, 0);
      },
      "9");
    ExpectMessage(
      [&](RenderScene& s)
      {
        s.lighting.shadows = shadows;
        s.lighting.light.position.z = notANumber;
      },
      "nan");
  }
}

TEST(RendererInput, RejectsImagesWithoutPointsSpacingOrPlace)
{
  ExpectMessage([](RenderScene& s) { s.grid.nodes.y = 0; }, " 0 ");
  ExpectMessage([](RenderScene& s) { s.grid.spacing.z = 0; }, " 0");
  ExpectMessage([](RenderScene& s) { s.grid.spacing.z = 1e38; }, "1e+38");
  ExpectMessage([](RenderScene& s) { s.grid.origin.x = notANumber; }, "nan");
  ExpectMessage([](RenderScene& s) { s.grid.direction[0] = Vec3(1, 0.5, 0); }, "0.5");
}

TEST(RendererInput, RejectsShadowRaysThatDoNotCoverAnything)
{
  ExpectMessage([](RenderScene& s) { s.shadowRayDensity = 0; }, " 0");
  ExpectMessage([](RenderScene& s) { s.shadowRayDensity = notANumber; }, "nan");
}

TEST(RendererInput, RejectsAShareThatLeadsNowhere)
{
  RenderScene scene = Ordinary();
  scene.Change({ 9, 9, 9 }, 1);
  Renderer renderer;
  scene.SetUp(renderer);
  for (const double share : { 0.0, -1.0, 1.5, notANumber })
  {
    EXPECT_THROW(
      renderer.SetExtinction(scene.changeGrid, scene.base.data(), scene.extinction.data(), share),
      Error)
      << share;
  }
}

TEST(RendererInput, RejectsAnExtinctionOnAGridWithoutVolume)
{
  RenderScene scene = Ordinary();
  scene.base.assign(81, 1.0f);
  scene.extinction.assign(81, 0.5f);
  scene.changeGrid = scene.grid;
  scene.changeGrid.nodes = { 1, 9, 9 };

  EXPECT_THROW(scene.Render(), Error);
}

TEST(RendererInput, RejectsAnExtinctionInAnotherBox)
{
  RenderScene scene = Ordinary();
  scene.Change({ 5, 5, 5 }, 1);
  scene.changeGrid.origin.x += 0.5;

  EXPECT_THROW(scene.Render(), Error);
  scene.changeGrid.origin.x -= 0.5;
  scene.changeGrid.spacing.y *= 1.1;
  EXPECT_THROW(scene.Render(), Error);
}

TEST(RendererInput, DrawsNothingWhereNothingAbsorbs)
{
  RenderScene scene = Ordinary();
  std::fill(scene.functions.extinction.begin(), scene.functions.extinction.end(), 0.0f);

  EXPECT_TRUE(IsEmpty(scene.Render()));
}

TEST(RendererInput, DrawsNothingOfAnImageWithoutVolume)
{
  for (const Int3& nodes : { Int3(1, 5, 5), Int3(5, 5, 1), Int3(1, 1, 1), Int3(7, 1, 1) })
  {
    const RenderScene whole = Ordinary();
    RenderScene scene = whole;
    scene.grid.nodes = nodes;

    EXPECT_TRUE(IsEmpty(scene.Render()));
  }
}

TEST(RendererInput, DrawsNothingOfScalarsThatAreNoNumbers)
{
  for (const double value : { notANumber, infinity, -infinity })
  {
    RenderScene scene = Ordinary();
    std::fill(scene.scalars.begin(), scene.scalars.end(), float(value));

    EXPECT_TRUE(IsEmpty(scene.Render())) << value;
  }
}

TEST(RendererInput, DrawsAnImageOfTwoNodesAlongEachAxis)
{
  RenderScene scene = RenderScene::Homogeneous(
    MakeGrid({ 2, 2, 2 }, { -1, -1, -1 }, { 2, 2, 2 }), 50, { { 1, 1, 1 } });
  scene.lighting.enabled = true;
  const Picture picture = scene.Render();

  EXPECT_EQ(picture.rgba[4 * (20 * 40 + 20) + 3], 255); // in the middle
}

TEST(RendererInput, DrawsOpaqueAndFaintMediaWithoutOverflow)
{
  for (const double extinction : { 1e-30, 1e-6, 1e6, 1e30 })
  {
    RenderScene scene = RenderScene::Homogeneous(
      MakeGrid({ 5, 5, 5 }, { -1, -1, -1 }, { 0.5, 0.5, 0.5 }), extinction, { { 1, 0.5f, 0 } });
    scene.lighting.enabled = true;
    scene.lighting.shadows = false;
    scene.lighting.anisotropy = 0;

    const Picture picture = scene.Render();

    const std::size_t middle = 4 * (20 * 40 + 20);
    const int alpha = extinction > 1 ? 255 : 0;
    EXPECT_EQ(picture.rgba[middle + 3], alpha) << extinction;
    EXPECT_EQ(picture.rgba[middle], alpha) << extinction;
    EXPECT_EQ(picture.rgba[middle + 2], 0) << extinction;
  }
}

TEST(RendererInput, DrawsFromTheVeryMiddleOfTheBox)
{
  // Lit by the phase relative to that in the middle, seen from there: any direction will do, but
  // it has to be one. [-1, 1]^3 and the eye in the origin leave no rounding to help.
  for (const Vec3& forward : { Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, -1, 0) })
  {
    RenderScene scene = RenderScene::Homogeneous(
      MakeGrid({ 9, 9, 9 }, { -1, -1, -1 }, { 0.25, 0.25, 0.25 }), 3, { { 1, 1, 1 } });
    scene.view.clipToWorld =
      Perspective(LookAt(Vec3(0), forward, Vec3(0.1, 0.2, 0.9)), 60, 1, 1e-3, 10);
    scene.lighting.enabled = true;
    scene.lighting.light.position = { 3, 4, 5 };

    const Picture picture = scene.Render();

    const std::size_t middle = 4 * (20 * 40 + 20);
    EXPECT_GT(picture.rgba[middle + 3], 200);
    EXPECT_GT(picture.rgba[middle], 0) << "no light";
  }
}

TEST(RendererInput, KeepsItsBrightnessWhenTheCameraTurnsInside)
{
  // A camera near the middle that turns sees the same medium under the same light: what is in the
  // same direction keeps its brightness. The middle passes from in front of it to behind it.
  RenderScene scene = RenderScene::Homogeneous(
    MakeGrid({ 9, 9, 9 }, { -1, -1, -1 }, { 0.25, 0.25, 0.25 }), 1, { { 0.2f, 0.2f, 0.2f } });
  scene.view.width = scene.view.height = 41;
  scene.lighting.enabled = true;
  scene.lighting.shadows = false;
  scene.lighting.light.type = LightType::Directional;
  scene.lighting.light.position = { 1, 0.2, 0.3 };
  const Vec3 eye(0.3, 0, 0);
  std::vector<int> brightness;
  for (const double degrees : { 80.0, 100.0 })
  {
    // What is looked at is the direction (0, 0, 1), 10 degrees from the middle of the picture.
    const double angle = degrees * truth::pi / 180;
    const Vec3 forward(-std::cos(angle), 0, std::sin(angle));
    scene.view.clipToWorld =
      Perspective(LookAt(eye, eye + forward, Vec3(0, 1, 0)), 60, 1, 1e-3, 10);
    const Frustum camera = LookAt(eye, eye + forward, Vec3(0, 1, 0));
    const double across = glm::dot(Vec3(0, 0, 1), camera.right) / glm::dot(Vec3(0, 0, 1), forward);
    const int column = int(std::lround(20.5 + 20.5 * across / std::tan(truth::pi / 6) - 0.5));
    const Picture picture = scene.Render();
    brightness.push_back(picture.rgba[4 * std::size_t(20 * 41 + column)]);
  }

  // The two pixels differ by half a pixel of 1.5 degrees at most: a few percent.
  EXPECT_NEAR(brightness[0], brightness[1], 0.1 * brightness[0] + 1);
}
