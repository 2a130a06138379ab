// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A small scene made from functions, for the solver and, in the same words, for the reference.

#ifndef limpid_testing_BoxScene_h
#define limpid_testing_BoxScene_h

#include "RayMarch.h"

#include "optimize/Solver.h"

#include <cmath>
#include <string>
#include <vector>

namespace limpid
{
inline truth::Vector ToTruth(const Vec3& v)
{
  return { { v.x, v.y, v.z } };
}

struct BoxScene
{
  Grid grid;
  std::vector<float> extinction;
  std::vector<float> importance;
  Camera camera;
  Light light;
  Settings settings;

  /// Nodes over a box with its lower corner in `origin`; the camera looks at its centre from
  /// (0.9, 1.3, -3) radii away, the light is as far away above.
  BoxScene(const Int3& nodes, const Vec3& origin, const Vec3& spacing)
  {
    grid.nodes = nodes;
    grid.origin = origin;
    grid.spacing = spacing;
    extinction.assign(static_cast<std::size_t>(grid.NodeCount()), 0.0f);
    importance.assign(static_cast<std::size_t>(grid.NodeCount()), 0.0f);
    const double radius = std::max(grid.Radius(), 1e-30);
    camera.focalPoint = grid.Centre();
    camera.position = grid.Centre() + radius * Vec3(0.9, 1.3, -3);
    light.position = grid.Centre() + radius * Vec3(-1, 3, -0.7);
    light.focalPoint = grid.Centre();
  }

  /// [-1, 1]^3 with `nodes` nodes along each axis.
  static BoxScene Cube(int nodes)
  {
    return BoxScene(Int3(nodes), Vec3(-1), Vec3(2.0 / (nodes - 1)));
  }

  /// Sets the fields to functions of the world position.
  template <class Extinction, class Importance>
  void Fill(Extinction extinctionAt, Importance importanceAt)
  {
    std::size_t node = 0;
    for (int k = 0; k < grid.nodes.z; ++k)
    {
      for (int j = 0; j < grid.nodes.y; ++j)
      {
        for (int i = 0; i < grid.nodes.x; ++i, ++node)
        {
          const Vec3 position = grid.PointToWorld(Vec3(i, j, k));
          extinction[node] = static_cast<float>(extinctionAt(position));
          importance[node] = static_cast<float>(importanceAt(position));
        }
      }
    }
  }

  /// An important core inside a shell that hides it, and noise in the air round both: a bit of
  /// everything. The box is taken as [-1, 1]^3 whatever its size. `opticalDepth` is the majorant
  /// times the radius.
  void FillOnion(double opticalDepth = 20)
  {
    const double radius = grid.Radius();
    const Vec3 half = 0.5 * (Vec3(grid.nodes) - 1.0) * grid.spacing;
    const Vec3 centre = grid.Centre();
    const auto unit = [=](const Vec3& x)
    { return (glm::transpose(grid.direction) * (x - centre)) / half; };
    const double majorant = opticalDepth / radius;
    Fill(
      [=](const Vec3& x)
      {
        const Vec3 y = unit(x);
        const double r = glm::length(y);
        const double shell = std::exp(-std::pow((r - 0.75) / 0.12, 2));
        const double core = std::exp(-std::pow(glm::length(y - Vec3(0.1, -0.1, 0.15)) / 0.35, 2));
        const double value = 0.5 * shell + core;
        return value < 0.02 ? 0.0 : majorant * std::min(1.0, value);
      },
      [=](const Vec3& x)
      {
        const double r = glm::length(unit(x) - Vec3(0.1, -0.1, 0.15));
        return std::min(1.0, std::max(0.0, 1.6 - 4 * r));
      });
  }

  /// An onion in [-1, 1]^3 with `nodes` nodes along each axis.
  static BoxScene Onion(int nodes = 25)
  {
    BoxScene scene = Cube(nodes);
    scene.FillOnion();
    return scene;
  }

  SceneFields Fields() const { return { grid, extinction.data(), importance.data() }; }

  Solver MakeSolver() const { return Solver(Fields(), camera, light, settings); }

  truth::Lattice Lattice() const
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

  truth::Source Eye() const
  {
    return camera.parallel ? truth::Source::Parallel(ToTruth(camera.focalPoint - camera.position))
                           : truth::Source::Point(ToTruth(camera.position));
  }

  truth::Source Lamp() const
  {
    return light.type == LightType::Directional
      ? truth::Source::Parallel(ToTruth(light.focalPoint - light.position))
      : truth::Source::Point(ToTruth(light.position));
  }

  /// What the reference sees with another extinction on the same nodes.
  truth::Volume<float> TruthWith(const std::vector<float>& other) const
  {
    return { Lattice(), other.data(), importance.data() };
  }

  double TrueScore(const std::vector<float>& other, double raysPerVoxel = 4) const
  {
    truth::Sampling sampling;
    sampling.raysPerVoxel = raysPerVoxel;
    return truth::VisibilityScore(TruthWith(other), Eye(), sampling);
  }

  double TrueTransmittance(int i, int j, int k) const
  {
    return truth::Transmittance(
      TruthWith(extinction), Eye(), ToTruth(grid.PointToWorld(Vec3(i, j, k))));
  }

  /// Calls visit(node, i, j, k) for every node.
  template <class Visit>
  void ForEachNode(Visit visit) const
  {
    std::size_t node = 0;
    for (int k = 0; k < grid.nodes.z; ++k)
    {
      for (int j = 0; j < grid.nodes.y; ++j)
      {
        for (int i = 0; i < grid.nodes.x; ++i, ++node)
        {
          visit(node, i, j, k);
        }
      }
    }
  }
};

/// A field that does not depend on the position.
inline auto Everywhere(double value)
{
  return [value](const Vec3&) { return value; };
}
}

#endif
