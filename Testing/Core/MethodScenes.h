// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Scenes on which the methods that the paper compares with have closed forms, and what they show.

#ifndef limpid_testing_MethodScenes_h
#define limpid_testing_MethodScenes_h

#include "BoxScene.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace limpid
{
constexpr double thickness = 3; // extinction of everything [1/length]
constexpr double width = 0.5;   // of the slabs [length]
constexpr double face = 4;      // of the cube [length^2]
inline const double radius = std::sqrt(3.0);

/// 1 inside, 0 outside, and a half on the border, which is one cell wide.
inline double Inside(double distanceToBorder, double cell)
{
  return std::min(std::max(0.5 + distanceToBorder / cell, 0.0), 1.0);
}

/// A cube seen along its last axis in parallel rays, with `cells` cells along each axis.
inline BoxScene ParallelCube(int cells)
{
  BoxScene scene = BoxScene::Cube(cells + 1);
  scene.camera.parallel = true;
  scene.camera.position = { 0, 0, -4 };
  scene.camera.focalPoint = { 0, 0, 0 };
  scene.light.type = LightType::Directional;
  scene.light.position = { 0, 0, -4 };
  scene.settings.ament.smoothingPasses = 0;
  scene.settings.ament.occluders = 30;
  return scene;
}

/// How far importance reaches beyond what is important, so that borders are important, too [cells].
constexpr double margin = 1;

/// The integral of squared importance through a slab: squares at the nodes, 1 on the border of the
/// slab and a quarter a cell outside.
inline double SquaredImportance(double cell)
{
  return width + 1.5 * cell;
}

/// An important slab behind what has `widthInFront(x)` in front of it; from z = 0.25 on.
inline BoxScene SlabBehind(int cells, const std::function<double(double)>& widthInFront)
{
  BoxScene scene = ParallelCube(cells);
  const double cell = 2.0 / cells;
  const auto slab = [=](const Vec3& x, double reach)
  { return Inside(std::min(x.z - 0.25, 0.25 + width - x.z) + reach, cell); };
  scene.Fill(
    [=](const Vec3& x)
    {
      const double end = -0.75 + widthInFront(x.x);
      const double front = end > -0.75 ? Inside(x.z + 0.75, cell) * Inside(end - x.z, cell) : 0.0;
      return thickness * std::min(front + slab(x, 0), 1.0);
    },
    [=](const Vec3& x) { return slab(x, margin * cell); });
  return scene;
}

inline BoxScene TwoSlabs(int cells)
{
  return SlabBehind(cells, [](double) { return width; });
}

inline BoxScene Wedge(int cells)
{
  return SlabBehind(cells, [](double x) { return 0.4 * (x + 1); });
}

constexpr double coreRadius = 0.35;

/// An important ball inside an unimportant shell.
inline BoxScene NestedShells(int cells)
{
  BoxScene scene = ParallelCube(cells);
  const double cell = 2.0 / cells;
  const auto core = [=](const Vec3& x, double reach)
  { return Inside(coreRadius - glm::length(x) + reach, cell); };
  scene.Fill(
    [=](const Vec3& x)
    {
      const double r = glm::length(x);
      return thickness * std::min(core(x, 0) + Inside(std::min(r - 0.6, 0.8 - r), cell), 1.0);
    },
    [=](const Vec3& x) { return core(x, margin * cell); });
  return scene;
}

struct Shown
{
  double score;
  double energy;
  std::vector<float> extinction;
  std::vector<float> lightExtinction;
};

inline Shown ShownBy(Method method, BoxScene& scene)
{
  scene.settings.method = method;
  Solver solver = scene.MakeSolver();
  solver.Run();
  return { solver.BestScore().visibility, solver.BestEnergy().Total(), solver.Extinction(),
    solver.LightExtinction() };
}
}

#endif
