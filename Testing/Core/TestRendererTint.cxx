// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Colours of structures in pictures.

#include "RenderScene.h"
#include "Tolerance.h"

#include "math/Require.h"
#include "render/StructureTint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <set>
#include <vector>

using namespace limpid;

namespace
{
using Rgb = std::array<float, 3>;

constexpr Rgb own{ { 0.8f, 0.8f, 0.2f } }; // of the transfer function
const std::vector<Rgb> colors{ { { 1.0f, 0.2f, 0.0f } }, { { 0.0f, 1.0f, 0.0f } },
  { { 0.1f, 0.3f, 1.0f } } };

/// The row of each node: `rowOf(i, j, k)`.
template <class RowOf>
std::vector<StructureRow> Rows(const Grid& grid, const RowOf& rowOf)
{
  std::vector<StructureRow> rows;
  for (int k = 0; k < grid.nodes.z; ++k)
  {
    for (int j = 0; j < grid.nodes.y; ++j)
    {
      for (int i = 0; i < grid.nodes.x; ++i)
      {
        rows.push_back(StructureRow(rowOf(i, j, k)));
      }
    }
  }
  return rows;
}

/// A homogeneous box of 6 x 6 x 8 cells, seen along z from its first slice on, parallel.
RenderScene Slabs(double extinction)
{
  RenderScene scene =
    RenderScene::Homogeneous(MakeGrid({ 7, 7, 9 }, Vec3(0), Vec3(1)), extinction, own);
  scene.view.width = 12;
  scene.view.height = 12;
  scene.view.opaqueBelow = 0;
  scene.view.clipToWorld =
    Parallel(LookAt(Vec3(3, 3, -5), Vec3(3, 3, 4), Vec3(0, 1, 0)), 3, 1, 1, 20);
  return scene;
}

Picture Tinted(RenderScene scene, const std::vector<StructureRow>& rows, double share)
{
  scene.structures = rows;
  scene.structureColors = share;
  scene.colorsOfRows = colors;
  return scene.Render();
}

const std::uint8_t* PixelOf(const Picture& picture, int column, int row)
{
  return picture.rgba.data() +
    4 * (std::size_t(row) * std::size_t(picture.width) + std::size_t(column));
}

/// Lights, overlays and kinds of compositing: every kernel that traces rays.
std::vector<RenderScene> Kinds()
{
  std::vector<RenderScene> scenes;
  for (const Compositing compositing :
    { Compositing::FrontToBack, Compositing::FromObject, Compositing::ImportanceMean })
  {
    for (const bool lit : { false, true })
    {
      for (const bool changed : { false, true })
      {
        RenderScene scene =
          RenderScene::Random(3, MakeGrid({ 13, 12, 14 }, Vec3(2, 1, 0), Vec3(1, 1.2, 0.9)), 6);
        scene.lighting.enabled = lit;
        scene.compositing = compositing;
        if (changed)
        {
          scene.Change(scene.grid.nodes, 4);
        }
        if (compositing != Compositing::FrontToBack)
        {
          std::mt19937 generator(5);
          scene.importance = RenderScene::Waves(scene.grid, generator);
          for (float& importance : scene.importance)
          {
            importance = std::min(std::max(2 * importance - 0.8f, 0.0f), 1.0f);
          }
        }
        scenes.push_back(scene);
      }
    }
  }
  return scenes;
}

std::vector<StructureRow> Blobs(const Grid& grid)
{
  return Rows(grid, [](int i, int j, int k) { return (i / 5 + j / 4 + k / 6) % 4; });
}
}

// Two slabs: what is seen of the second one has passed the first one. Their border is in the middle
// between slices 3 and 4, where a segment ends.
TEST(RendererTint, ComposesTheColoursOfTwoSlabs)
{
  const double extinction = 0.3;
  RenderScene scene = Slabs(extinction);
  scene.view.sampleDistance = 0.5;
  const std::vector<StructureRow> rows =
    Rows(scene.grid, [](int, int, int k) { return k < 4 ? 1 : 3; });
  for (const double share : { 1.0, 0.4 })
  {
    const Picture picture = Tinted(scene, rows, share);

    const double first = 1 - std::exp(-3.5 * extinction);
    const double second = std::exp(-3.5 * extinction) - std::exp(-8 * extinction);
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      const auto mixed = [&](std::size_t row)
      { return (1 - share) * own[channel] + share * colors[row - 1][channel]; };
      const double expected = 255 * (first * mixed(1) + second * mixed(3));
      // Half a unit of 8 bits, and the roundings of 16 segments in single precision.
      const Tolerance tolerance = Tolerance{ 0.5, "8 bits" } + Roundoff<float>(16 * 16, 255.0);
      EXPECT_WITHIN(PixelOf(picture, 5, 6)[channel], expected, tolerance);
    }
  }
}

TEST(RendererTint, OfNothingIsThePictureWithoutItBitForBit)
{
  for (const RenderScene& scene : Kinds())
  {
    const Picture plain = scene.Render();

    EXPECT_EQ(Tinted(scene, Blobs(scene.grid), 0).rgba, plain.rgba);
    EXPECT_EQ(Tinted(scene, Rows(scene.grid, [](int, int, int) { return 0; }), 1).rgba, plain.rgba);
    EXPECT_EQ(Tinted(scene, Rows(scene.grid, [](int, int, int) { return 4; }), 1).rgba, plain.rgba)
      << "rows without a colour";
    EXPECT_NE(Tinted(scene, Blobs(scene.grid), 1).rgba, plain.rgba);
  }
}

// If every structure has the colour of the transfer function, only rounding differs.
TEST(RendererTint, InTheOwnColourIsThePictureWithoutIt)
{
  for (RenderScene scene : Kinds())
  {
    std::fill(scene.functions.color.begin(), scene.functions.color.end(), colors[1]);
    const Picture plain = scene.Render();
    const Picture tinted = Tinted(scene, Rows(scene.grid, [](int, int, int) { return 2; }), 0.7);

    int worst = 0;
    for (std::size_t byte = 0; byte < plain.rgba.size(); ++byte)
    {
      worst = std::max(worst, std::abs(int(plain.rgba[byte]) - int(tinted.rgba[byte])));
    }
    EXPECT_LE(worst, 1) << "more than the last bit";
  }
}

// Labels 1 and 3 side by side, opaque: a pixel has the colour of one of them, and neither that of
// label 2 between them nor a mixture, however oblique the border and however large the picture.
TEST(RendererTint, HasOnlyTheColoursOfBothSidesAlongABorder)
{
  RenderScene scene = Slabs(60);
  scene.view.width = 301;
  scene.view.height = 301;
  const std::vector<StructureRow> rows =
    Rows(scene.grid, [](int i, int j, int) { return 2 * i + j < 9 ? 1 : 3; });
  const Picture picture = Tinted(scene, rows, 1);

  std::set<std::vector<int>> found;
  for (int row = 1; row < 300; ++row)
  {
    for (int column = 1; column < 300; ++column)
    {
      const std::uint8_t* pixel = PixelOf(picture, column, row);
      found.insert({ pixel[0], pixel[1], pixel[2] });
    }
  }
  const auto bytes = [](const Rgb& color)
  {
    std::vector<int> all;
    for (const float channel : color)
    {
      all.push_back(int(255 * channel + 0.5f));
    }
    return all;
  };
  EXPECT_EQ(found, (std::set<std::vector<int>>{ bytes(colors[0]), bytes(colors[2]) }));
}

// The border of a half space whose nodes are exactly on both sides is the plane between, at any
// place within the cells: not a staircase of nodes.
TEST(RendererTint, HasBordersBetweenNodes)
{
  RenderScene scene = Slabs(60);
  scene.view.width = 600;
  scene.view.height = 6;
  const std::vector<StructureRow> rows =
    Rows(scene.grid, [](int i, int, int) { return i < 3 ? 1 : 3; });
  const Picture picture = Tinted(scene, rows, 1);

  int changes = 0;
  for (int column = 1; column < 600; ++column)
  {
    const bool isOther = PixelOf(picture, column - 1, 3)[2] != PixelOf(picture, column, 3)[2];
    changes += isOther ? 1 : 0;
    // 100 pixels per node; x grows to the left, and the border is at x = 2.5.
    EXPECT_TRUE(!isOther || std::abs(column - 350) <= 1) << column;
  }
  EXPECT_EQ(changes, 1);
}

TEST(RowInCell, IsThatOfTheLargestSumOfWeights)
{
  std::mt19937 generator(7);
  std::uniform_int_distribution<int> label(0, 3);
  std::uniform_real_distribution<float> share(0, 1);
  const CellGrid grid(Int3(2, 2, 2));
  for (int i = 0; i < 2000; ++i)
  {
    std::array<StructureRow, 8> nodes{};
    std::generate(nodes.begin(), nodes.end(), [&] { return StructureRow(label(generator)); });
    const float at[3] = { share(generator), share(generator), share(generator) };

    const StructureRow found = RowInCell(grid, nodes.data(), at[0], at[1], at[2]);

    std::array<double, 4> sums{};
    for (std::size_t node = 0; node < 8; ++node)
    {
      double weight = 1;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        weight *= (node >> axis & 1) != 0 ? double(at[axis]) : 1 - double(at[axis]);
      }
      sums[nodes[node]] += weight;
    }
    // Sums that are equal but for their rounding leave a choice.
    const double most = *std::max_element(sums.begin(), sums.end());
    EXPECT_GE(sums[found], most - 16 * double(std::numeric_limits<float>::epsilon()));
  }
}

TEST(RendererTint, IsThatOfAFreshRendererAfterAnyChange)
{
  const RenderScene scene = Kinds()[3];
  const std::vector<StructureRow> rows = Blobs(scene.grid);
  Renderer renderer;
  scene.SetUp(renderer);
  const auto drawn = [&]
  {
    Picture picture;
    renderer.Render(scene.WholeView(), picture);
    return picture.rgba;
  };
  renderer.SetStructures(rows.data());
  renderer.TintStructures(1, { colors[1] });
  drawn();

  renderer.TintStructures(0.5, colors);
  EXPECT_EQ(drawn(), Tinted(scene, rows, 0.5).rgba);
  renderer.TintStructures(0, colors);
  EXPECT_EQ(drawn(), scene.Render().rgba);
  renderer.TintStructures(1, colors);
  renderer.SetStructures(nullptr);
  EXPECT_EQ(drawn(), scene.Render().rgba);
  renderer.SetStructures(rows.data());
  renderer.SetScalars(scene.grid, scene.scalars.data());
  EXPECT_EQ(drawn(), scene.Render().rgba) << "new scalars discard the structures";
}

TEST(RendererTint, RefusesImpossibleInput)
{
  Renderer renderer;
  const StructureRow row = 0;
  EXPECT_THROW(renderer.SetStructures(&row), Error) << "no scalars";
  for (const double share : { -0.1, 1.1, std::nan("") })
  {
    EXPECT_THROW(renderer.TintStructures(share, colors), Error) << share;
  }
  EXPECT_THROW(renderer.TintStructures(1, { { { 0, 1.5f, 0 } } }), Error);
}
