// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A small scene to be drawn, for the renderer and, in the same words, for the reference.

#ifndef limpid_testing_RenderScene_h
#define limpid_testing_RenderScene_h

#include "PictureMarch.h"
#include "Viewing.h"

#include "render/Renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace limpid
{
inline truth::Vector TruthOf(const Vec3& v)
{
  return { { v.x, v.y, v.z } };
}

inline truth::Lattice TruthOf(const Grid& grid)
{
  truth::Lattice lattice;
  for (int c = 0; c < 3; ++c)
  {
    lattice.nodes[c] = grid.nodes[c];
    lattice.origin[c] = grid.origin[c];
    lattice.spacing[c] = grid.spacing[c];
    for (int row = 0; row < 3; ++row)
    {
      lattice.direction[3 * row + c] = grid.direction[c][row];
    }
  }
  return lattice;
}

inline truth::Field<double> TruthOf(const Grid& grid, const std::vector<float>& values)
{
  return { TruthOf(grid), { values.begin(), values.end() } };
}

inline truth::Source TruthOf(const Light& light)
{
  return light.type == LightType::Directional
    ? truth::Source::Parallel(TruthOf(light.focalPoint - light.position))
    : truth::Source::Point(TruthOf(light.position));
}

inline Grid MakeGrid(const Int3& nodes, const Vec3& origin, const Vec3& spacing)
{
  Grid grid;
  grid.nodes = nodes;
  grid.origin = origin;
  grid.spacing = spacing;
  return grid;
}

/// Returns a grid over the same box with other nodes.
inline Grid WithNodes(const Grid& grid, const Int3& nodes)
{
  Grid other = grid;
  other.nodes = nodes;
  other.spacing = grid.spacing * (Vec3(grid.nodes) - 1.0) / (Vec3(nodes) - 1.0);
  return other;
}

struct RenderScene
{
  Grid grid;
  std::vector<float> scalars;
  TransferFunctions functions;
  Grid changeGrid;
  std::vector<float> base; ///< with `extinction`; both empty: the transfer function's alone
  std::vector<float> extinction;
  Lighting lighting;
  double shadowRayDensity = 3;   // as in Renderer.h
  std::vector<float> importance; ///< of what is missed, which is painted; empty: it is not
  Compositing compositing = Compositing::FrontToBack; ///< others: nothing is painted
  std::array<float, 3> missedColor{ { 1, 0, 1 } };
  std::vector<StructureRow> structures; ///< empty: none
  double structureColors = 0;           ///< share of the following
  std::vector<std::array<float, 3>> colorsOfRows;
  View view;
  std::vector<float> nearDepth; ///< of `view`; empty: rays begin where they can
  std::vector<float> depth;     ///< of `view`; empty: nothing opaque

  /// Scalars and a transfer function without structure: extinction and colour everywhere.
  static RenderScene Homogeneous(
    const Grid& grid, double extinction, const std::array<float, 3>& color)
  {
    RenderScene scene;
    scene.grid = grid;
    scene.scalars.assign(static_cast<std::size_t>(grid.NodeCount()), 0.5f);
    scene.functions.extinction = { float(extinction), float(extinction) };
    scene.functions.color = { color, color };
    scene.LookAtBox(Direction(0.9, 1.3, -3));
    return scene;
  }

  /// Smooth random scalars in [0, 1] and random transfer functions with a gap and steep sides.
  /// `opticalDepth`: of the majorant over the half diagonal.
  static RenderScene Random(unsigned seed, const Grid& grid, double opticalDepth)
  {
    RenderScene scene;
    scene.grid = grid;
    std::mt19937 generator(seed);
    scene.scalars = Waves(grid, generator);
    std::uniform_real_distribution<float> share(0, 1);
    const int entries = 33;
    for (int entry = 0; entry < entries; ++entry)
    {
      const bool gap = entry < 6 || (entry > 14 && entry < 18);
      const double height = gap ? 0.0 : 0.3 + 0.7 * share(generator);
      scene.functions.extinction.push_back(float(height * opticalDepth / grid.Radius()));
      const float red = 0.5f + 0.5f * float(std::sin(0.3 * entry + 6 * share(generator) / 30));
      scene.functions.color.push_back({ { red, float(entry) / entries, 1 - 0.7f * red } });
    }
    scene.LookAtBox(Direction(0.9, 1.3, -3));
    scene.lighting.light.position = grid.Centre() + grid.Radius() * Vec3(-1, 3, -0.7);
    scene.lighting.light.focalPoint = grid.Centre();
    return scene;
  }

  static std::vector<float> Waves(const Grid& grid, std::mt19937& generator)
  {
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<float> values(static_cast<std::size_t>(grid.NodeCount()), 0.5f);
    for (int wave = 0; wave < 8; ++wave)
    {
      const Vec3 number(uniform(generator), uniform(generator), uniform(generator));
      const double phase = 3 * uniform(generator);
      std::size_t node = 0;
      for (int k = 0; k < grid.nodes.z; ++k)
      {
        for (int j = 0; j < grid.nodes.y; ++j)
        {
          for (int i = 0; i < grid.nodes.x; ++i, ++node)
          {
            const Vec3 unit = Vec3(i, j, k) / (Vec3(grid.nodes) - 1.0);
            values[node] += float(0.16 * std::sin(7 * glm::dot(number, unit) + phase));
          }
        }
      }
    }
    return values;
  }

  /// A change of the extinction on a grid of its own: up here, down there.
  void Change(const Int3& nodes, unsigned seed)
  {
    std::mt19937 generator(seed);
    changeGrid = WithNodes(grid, nodes);
    base = Waves(changeGrid, generator);
    extinction = Waves(changeGrid, generator);
    const float majorant =
      *std::max_element(functions.extinction.begin(), functions.extinction.end());
    for (std::size_t node = 0; node < base.size(); ++node)
    {
      base[node] = std::min(1.0f, std::max(0.0f, base[node])) * majorant;
      const float moved = std::max(0.0f, 2.2f * extinction[node] - 0.6f);
      extinction[node] = std::min(1.0f, moved) * majorant;
    }
  }

  /// From this direction, seen from the middle of the box; the box fits into the picture.
  void LookAtBox(const Vec3& direction, int size = 40)
  {
    view.width = size;
    view.height = size;
    const Vec3 eye = grid.Centre() + 3.2 * grid.Radius() * direction;
    view.clipToWorld = Perspective(
      LookAt(eye, grid.Centre(), Vec3(0, 1, 0.1)), 35, 1, 1.5 * grid.Radius(), 5 * grid.Radius());
  }

  static Vec3 Direction(double x, double y, double z) { return glm::normalize(Vec3(x, y, z)); }

  void SetUp(Renderer& renderer) const
  {
    renderer.SetScalars(grid, scalars.data());
    renderer.SetTransferFunctions(functions);
    if (!extinction.empty())
    {
      renderer.SetExtinction(changeGrid, base.data(), extinction.data());
    }
    renderer.SetShadowRayDensity(shadowRayDensity);
    renderer.SetLighting(lighting);
    if (!importance.empty())
    {
      renderer.SetImportance(importance.data());
      renderer.ComposeBy(compositing);
      if (compositing == Compositing::FrontToBack)
      {
        renderer.ShowMissed(missedColor);
      }
    }
    if (!structures.empty())
    {
      renderer.SetStructures(structures.data());
      renderer.TintStructures(structureColors, colorsOfRows);
    }
  }

  /// The view with the scene's depths.
  View WholeView() const
  {
    View whole = view;
    whole.nearDepth = nearDepth.empty() ? nullptr : nearDepth.data();
    whole.depth = depth.empty() ? nullptr : depth.data();
    return whole;
  }

  Picture Render() const
  {
    Renderer renderer;
    SetUp(renderer);
    Picture picture;
    renderer.Render(WholeView(), picture);
    return picture;
  }

  truth::Medium Truth() const
  {
    truth::Medium medium;
    medium.scalars = TruthOf(grid, scalars);
    medium.extinction.low = medium.color.low = functions.low;
    medium.extinction.high = medium.color.high = functions.high;
    medium.extinction.values.assign(functions.extinction.begin(), functions.extinction.end());
    for (const std::array<float, 3>& color : functions.color)
    {
      medium.color.values.push_back({ { color[0], color[1], color[2] } });
    }
    if (!extinction.empty())
    {
      medium.base = TruthOf(changeGrid, base);
      medium.changed = TruthOf(changeGrid, extinction);
    }
    truth::Illumination& light = medium.light;
    light.enabled = lighting.enabled;
    light.lamp = TruthOf(lighting.light);
    light.intensity = lighting.intensity;
    light.ambient = lighting.ambient;
    light.anisotropy = lighting.anisotropy;
    light.surface = lighting.surface;
    light.specularPower = lighting.specularPower;
    light.shadowStrength = lighting.shadows ? lighting.shadowStrength : 0.0;
    light.cell = std::max({ grid.spacing.x, grid.spacing.y, grid.spacing.z });
    return medium;
  }

  truth::Frame Frame() const
  {
    truth::Frame frame;
    frame.width = view.width;
    frame.height = view.height;
    for (int column = 0; column < 4; ++column)
    {
      for (int row = 0; row < 4; ++row)
      {
        frame.clipToWorld[4 * std::size_t(column) + std::size_t(row)] =
          view.clipToWorld[column][row];
      }
    }
    frame.depth = depth.empty() ? nullptr : depth.data();
    return frame;
  }

  double SmallestSpacing() const
  {
    return std::min({ grid.spacing.x, grid.spacing.y, grid.spacing.z });
  }

  /// Distance between samples [length].
  double StepLength() const { return view.sampleDistance * SmallestSpacing(); }
};
}

#endif
