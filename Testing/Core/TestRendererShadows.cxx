// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Shadows on opaque surfaces: their borders are where the light's way past the caster says, and no
// sharper than the nodes are close. A lit surface casts none on itself, however obliquely it is
// lit.

#include "PictureErrors.h"
#include "RenderScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
constexpr double facePlace = 24.4;   ///< along z, where the opaque half space begins
constexpr double lidPlace = 12.5;    ///< middle of the lid, along z
constexpr double lidThickness = 2.5; ///< half of it
constexpr double viewHalf = 5;       ///< half the height of the picture
constexpr std::size_t pixels = 64;   ///< along each side of it
const double degree = truth::pi / 180;

/// An opaque half space whose face looks along -z, to the camera and to an oblique light.
struct HalfSpace
{
  RenderScene scene;
  Vec3 toLight;

  /// `perCell`: optical depth of a cell inside. `elevation`: of the light over the view [degrees].
  HalfSpace(double perCell, double elevation)
    : toLight(0, std::sin(elevation * degree), -std::cos(elevation * degree))
  {
    scene =
      RenderScene::Homogeneous(MakeGrid({ 40, 40, 32 }, {}, { 1, 1, 1 }), perCell, { { 1, 1, 1 } });
    scene.functions.extinction = { 0, float(perCell) };
    this->Fill([](const Vec3& node) { return node.z - facePlace; });
    const Vec3 middle = scene.grid.Centre();
    scene.view.width = scene.view.height = int(pixels);
    scene.view.clipToWorld =
      Parallel(LookAt(middle - Vec3(0, 0, 70), middle, { 0, 1, 0 }), viewHalf, 1, 20, 120);
    scene.lighting.enabled = true;
    scene.lighting.light.type = LightType::Directional;
    scene.lighting.light.focalPoint = middle;
    scene.lighting.light.position = middle + 100.0 * toLight;
  }

  /// Adds what is inside, where `depth` from the surface is above zero, with a slope of one cell.
  template <class Depth>
  void Fill(const Depth& depth)
  {
    std::size_t at = 0;
    for (int k = 0; k < scene.grid.nodes.z; ++k)
    {
      for (int j = 0; j < scene.grid.nodes.y; ++j)
      {
        for (int i = 0; i < scene.grid.nodes.x; ++i, ++at)
        {
          const double inside = std::clamp(0.5 + depth(Vec3(i, j, k)), 0.0, 1.0);
          scene.scalars[at] = std::max(at < filled ? scene.scalars[at] : 0.0f, float(inside));
        }
      }
    }
    filled = at;
  }

  /// Adds a thick lid above the face, from a straight border in x and y on.
  void AddLid(const Vec3& normal, double border)
  {
    this->Fill(
      [&](const Vec3& node)
      {
        const double beside = glm::dot(node, normal) - border;
        return std::min(beside, lidThickness - std::abs(node.z - lidPlace));
      });
  }

  /// Place of a pixel on the face [cells].
  Vec3 PlaceOf(std::size_t column, std::size_t row) const
  {
    const Vec3 middle = scene.grid.Centre();
    const double pixel = 2 * viewHalf / double(pixels);
    return { middle.x + viewHalf - pixel * (double(column) + 0.5),
      middle.y - viewHalf + pixel * (double(row) + 0.5), facePlace };
  }

  std::size_t filled = 0; ///< number of nodes that have been set
};

/// Brightness of pixels against their distance from where the shadow ends, positive in the shadow.
struct Profile
{
  struct Pixel
  {
    double distance;
    double brightness;
  };
  std::vector<Pixel> pixels;

  double Mean(double from, double to) const
  {
    double sum = 0;
    int count = 0;
    for (const Pixel& pixel : this->pixels)
    {
      const bool inside = pixel.distance >= from && pixel.distance < to;
      sum += inside ? pixel.brightness : 0.0;
      count += inside ? 1 : 0;
    }
    return sum / count;
  }

  /// Largest and least brightness of pixels at about this distance.
  double Spread(double from, double to) const
  {
    double least = 1;
    double most = 0;
    for (const Pixel& pixel : this->pixels)
    {
      if (pixel.distance >= from && pixel.distance < to)
      {
        least = std::min(least, pixel.brightness);
        most = std::max(most, pixel.brightness);
      }
    }
    return most - least;
  }
};

/// The border of the shadow of a lid, turned about the view [degrees].
Profile ProfileOf(double perCell, double angle)
{
  HalfSpace half(perCell, 40);
  const Vec3 normal(std::sin(angle * degree), std::cos(angle * degree), 0);
  // Light that reaches the face passes the middle of the lid by so much farther along y.
  const double shift = (facePlace - lidPlace) * normal.y * half.toLight.y / -half.toLight.z;
  const double border = glm::dot(half.scene.grid.Centre(), normal);
  half.AddLid(normal, border + shift);

  const Picture picture = half.scene.Render();
  Profile profile;
  for (std::size_t row = 0; row < pixels; ++row)
  {
    for (std::size_t column = 0; column < pixels; ++column)
    {
      const double distance = glm::dot(half.PlaceOf(column, row), normal) - border;
      profile.pixels.push_back({ distance, Channel(picture, pixels * row + column, 0) });
    }
  }
  return profile;
}
}

TEST(RendererShadows, EndSmoothlyWhereTheLightPassesTheirCaster)
{
  for (const double perCell : { 2.0, 10.0, 100.0 })
  {
    for (const double angle : { 0.0, 20.0, 45.0 })
    {
      SCOPED_TRACE(std::to_string(perCell) + " per cell, turned by " + std::to_string(angle));
      const Profile profile = ProfileOf(perCell, angle);

      const double lit = profile.Mean(-5, -4);
      const double dark = profile.Mean(3, 4);
      EXPECT_GT(lit, 0.98);
      EXPECT_LT(dark, 0.65);
      // A cell of the shadows blurs their border by a cell on either side, and the light of a
      // surface is that of the nodes around it.
      EXPECT_NEAR(profile.Mean(-4, -2.5), lit, 0.1 * (lit - dark));
      EXPECT_NEAR(profile.Mean(2, 3), dark, 0.1 * (lit - dark));
      for (double place = -3; place < 3; place += 0.25)
      {
        const double slope =
          profile.Mean(place, place + 0.25) - profile.Mean(place + 0.5, place + 0.75);
        EXPECT_LT(slope, 0.35 * (lit - dark)) << "not sharper than the nodes, at " << place;
        EXPECT_GT(slope, -0.01) << "no second border at " << place;
        EXPECT_LT(profile.Spread(place, place + 0.25), 0.5 * (lit - dark))
          << "a straight border, at " << place;
      }
    }
  }
}

TEST(RendererShadows, OfASurfaceOnItselfDoNotShowHoweverObliqueTheLightIs)
{
  for (const double perCell : { 10.0, 100.0 })
  {
    for (const double elevation : { 0.0, 30.0, 50.0, 60.0, 70.0, 80.0 })
    {
      SCOPED_TRACE(std::to_string(perCell) + " per cell, light at " + std::to_string(elevation));
      HalfSpace half(perCell, elevation);
      const Picture with = half.scene.Render();
      half.scene.lighting.shadows = false;
      const Picture without = half.scene.Render();

      for (std::size_t pixel = 0; pixel < pixels * pixels; ++pixel)
      {
        ASSERT_NEAR(Channel(with, pixel, 0), Channel(without, pixel, 0), 0.02);
      }
    }
  }
}
