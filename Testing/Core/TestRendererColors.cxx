// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The colours of pictures are those of the transfer function: on a surface that faces camera and
// light they are its own, elsewhere darker, and nowhere of another hue.

#include "PictureErrors.h"
#include "RenderScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
/// The patches of the usual color chart, in 8 bits of sRGB.
constexpr int chart[24][3] = { { 115, 82, 68 }, { 194, 150, 130 }, { 98, 122, 157 },
  { 87, 108, 67 }, { 133, 128, 177 }, { 103, 189, 170 }, { 214, 126, 44 }, { 80, 91, 166 },
  { 193, 90, 99 }, { 94, 60, 108 }, { 157, 188, 64 }, { 224, 163, 46 }, { 56, 61, 150 },
  { 70, 148, 73 }, { 175, 54, 60 }, { 231, 199, 31 }, { 187, 86, 149 }, { 8, 133, 161 },
  { 243, 243, 242 }, { 200, 200, 200 }, { 160, 160, 160 }, { 122, 122, 121 }, { 85, 85, 85 },
  { 52, 52, 52 } };

using Rgb = std::array<double, 3>;

Rgb PatchOf(int patch)
{
  return { chart[patch][0] / 255.0, chart[patch][1] / 255.0, chart[patch][2] / 255.0 };
}

double LuminanceOf(const Rgb& color)
{
  return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
}

/// The chromatic part of a colour in the plane of hues.
std::array<double, 2> ChromaOf(const Rgb& color)
{
  return { color[0] - 0.5 * (color[1] + color[2]), std::sqrt(0.75) * (color[1] - color[2]) };
}

/// Angle between the hues of two colours, less what rounding to 8 bits can turn it by [degrees].
double HueError(const Rgb& found, const Rgb& expected)
{
  const std::array<double, 2> a = ChromaOf(found);
  const std::array<double, 2> b = ChromaOf(expected);
  const double length = std::hypot(a[0], a[1]);
  const double rounding = 1.0 / 255;
  if (length <= rounding)
  {
    return 0; // grey, as far as 8 bits tell
  }
  const double angle = std::abs(std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]));
  return (angle - std::asin(rounding / length)) * 180 / truth::pi;
}

/// An opaque block behind empty space, whose face looks along -z.
struct Block
{
  static constexpr int depth = 40; ///< nodes
  static constexpr int face = 10;  ///< node at which it begins

  RenderScene scene;

  /// `perCell`: optical depth of a cell inside; `ramp`: cells in which the scalar rises.
  Block(const Rgb& color, double perCell, int ramp)
  {
    const Grid grid = MakeGrid({ 17, 17, depth }, { 0, 0, 0 }, { 1, 1, 1 });
    const std::array<float, 3> own{ float(color[0]), float(color[1]), float(color[2]) };
    scene = RenderScene::Homogeneous(grid, perCell, own);
    scene.functions.extinction = { 0, float(perCell) };
    for (int k = 0; k < depth; ++k)
    {
      const float inside = std::clamp(float(k - face) / float(ramp), 0.0f, 1.0f);
      std::fill_n(scene.scalars.begin() + k * 17 * 17, 17 * 17, inside);
    }
    const Vec3 middle = grid.Centre();
    scene.view.width = scene.view.height = 21;
    scene.view.clipToWorld =
      Perspective(LookAt(middle - Vec3(0, 0, 70), middle, { 0, 1, 0 }), 8, 1, 20, 120);
    scene.lighting.enabled = true;
  }

  /// A light from far away, turned up and to the right of the camera [degrees].
  void LightFrom(double elevation, double azimuth)
  {
    const double up = elevation * truth::pi / 180;
    const double right = azimuth * truth::pi / 180;
    scene.lighting.light.type = LightType::Directional;
    scene.lighting.light.focalPoint = scene.grid.Centre();
    scene.lighting.light.position = scene.grid.Centre() +
      100.0 * Vec3(std::cos(up) * std::sin(right), std::sin(up), -std::cos(up) * std::cos(right));
  }

  /// Colours of the pixels.
  std::vector<Rgb> Colors() const
  {
    const Picture picture = scene.Render();
    std::vector<Rgb> colors;
    for (std::size_t pixel = 0; pixel < picture.rgba.size() / 4; ++pixel)
    {
      colors.push_back(
        { Channel(picture, pixel, 0), Channel(picture, pixel, 1), Channel(picture, pixel, 2) });
    }
    return colors;
  }
};

/// The default light of a view of ParaView, the key light of its kit, and that of one of VTK.
constexpr double lights[][2] = { { 50, 10 }, { 0, 0 } };

/// Expects the luminance of the patch as a whole and the hue of every pixel. No pixel may be
/// brighter.
void ExpectFacingColor(const Block& block, const Rgb& own)
{
  const std::vector<Rgb> colors = block.Colors();
  double mean = 0;
  for (const Rgb& found : colors)
  {
    mean += LuminanceOf(found) / double(colors.size());
    EXPECT_LE(LuminanceOf(found), LuminanceOf(own) + 0.5 / 255);
    EXPECT_LE(HueError(found, own), 1);
  }
  EXPECT_NEAR(mean, LuminanceOf(own), 0.02 * LuminanceOf(own) + 0.5 / 255);
}
}

TEST(RendererColors, OfAFaceTowardsCameraAndLightAreThoseOfTheTransferFunction)
{
  for (const auto& light : lights)
  {
    for (int patch = 0; patch < 24; ++patch)
    {
      SCOPED_TRACE("patch " + std::to_string(patch) + ", light from " + std::to_string(light[0]));
      Block block(PatchOf(patch), 2, 1);
      block.LightFrom(light[0], light[1]);

      ExpectFacingColor(block, PatchOf(patch));
    }
  }
}

TEST(RendererColors, OfAFaceDoNotDependOnHowSharplyItBegins)
{
  const Rgb color = PatchOf(1);
  for (const auto& light : lights)
  {
    for (const double perCell : { 2.0, 5.0, 10.0, 100.0 })
    {
      for (const int ramp : { 1, 4 })
      {
        SCOPED_TRACE(std::to_string(perCell) + " per cell, rising in " + std::to_string(ramp) +
          ", light from " + std::to_string(light[0]));
        Block block(color, perCell, ramp);
        block.LightFrom(light[0], light[1]);

        ExpectFacingColor(block, color);
      }
    }
  }
}

TEST(RendererColors, AreNowhereBrighterAndNowhereOfAnotherHue)
{
  // Random media in random light, highlights and all, of one colour.
  const Rgb own = PatchOf(15);
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    RenderScene scene = RenderScene::Random(seed, MakeGrid({ 17, 15, 13 }, {}, { 1, 1, 1 }), 40);
    std::fill(scene.functions.color.begin(), scene.functions.color.end(),
      std::array<float, 3>{ float(own[0]), float(own[1]), float(own[2]) });
    scene.lighting.enabled = true;
    scene.lighting.surface = 2.0 * seed;
    scene.lighting.specularPower = 20.0 * seed;
    const Picture picture = scene.Render();

    for (std::size_t pixel = 0; pixel < picture.rgba.size() / 4; ++pixel)
    {
      const double alpha = Channel(picture, pixel, 3);
      const Rgb found{ Channel(picture, pixel, 0), Channel(picture, pixel, 1),
        Channel(picture, pixel, 2) };
      EXPECT_LE(LuminanceOf(found), alpha * LuminanceOf(own) + 1.0 / 255);
      EXPECT_LE(HueError(found, own), 1);
    }
  }
}

TEST(RendererColors, KeepTheirHueInLightThatIsTooStrong)
{
  for (int patch = 0; patch < 24; ++patch)
  {
    const Rgb own = PatchOf(patch);
    const double brightest = *std::max_element(own.begin(), own.end());
    for (const double intensity : { 2.0, 10.0 })
    {
      SCOPED_TRACE("patch " + std::to_string(patch) + " times " + std::to_string(intensity));
      Block block(own, 2, 1);
      block.LightFrom(0, 0);
      block.scene.lighting.ambient = 0;
      block.scene.lighting.intensity = intensity;

      const double factor = std::min(intensity, 1 / brightest);
      for (const Rgb& found : block.Colors())
      {
        EXPECT_NEAR(LuminanceOf(found), factor * LuminanceOf(own),
          0.02 * factor * LuminanceOf(own) + 0.5 / 255);
        EXPECT_LE(HueError(found, own), 1);
      }
    }
  }
}

TEST(RendererColors, OfAShadowAreDarkerAndOfTheSameHue)
{
  // A lid of the same matter over the block, between it and the light, and beside the view.
  const Rgb own = PatchOf(0);
  Block block(own, 10, 1);
  block.LightFrom(60, 0);
  const std::vector<Rgb> lit = block.Colors();
  for (int k = 0; k < Block::face; ++k)
  {
    std::fill_n(block.scene.scalars.begin() + k * 17 * 17 + 15 * 17, 2 * 17, 1.0f);
  }
  const std::vector<Rgb> shadowed = block.Colors();

  const std::size_t middle = 10 * 21 + 10;
  EXPECT_LT(LuminanceOf(shadowed[middle]), 0.8 * LuminanceOf(lit[middle]));
  EXPECT_GT(LuminanceOf(shadowed[middle]), 0.4 * LuminanceOf(lit[middle]));
  EXPECT_LE(HueError(shadowed[middle], own), 1);
}
