// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A scene file as solver and ray march take it.

#ifndef limpid_testing_benchmarks_Scene_h
#define limpid_testing_benchmarks_Scene_h

#include "SceneFile.h"

#include "optimize/Solver.h"

#include <string>
#include <vector>

namespace limpid::benchmark
{
struct Scene
{
  truth::SceneFile file;
  Grid grid;
  Camera camera;
  Light light;

  /// Throws std::runtime_error with the reason when the scene cannot be read.
  explicit Scene(const std::string& path);

  SceneFields Fields() const;
  Solver MakeSolver(const Settings& settings) const;

  /// S by the independent ray march of `extinction` [length^2].
  double March(const std::vector<float>& extinction, double raysPerVoxel) const;
};
}

#endif
