// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Finds the extinction that lets an important ball be seen through the fog around it, and says how
// much of it can be seen.

#include "optimize/Solver.h"

#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <vector>

namespace
{
/// A cube from -1 to 1, with `nodes` nodes along each axis.
limpid::Grid MakeGrid(int nodes)
{
  limpid::Grid grid;
  grid.nodes = limpid::Int3(nodes);
  grid.origin = limpid::Vec3(-1.0);
  grid.spacing = limpid::Vec3(2.0 / (nodes - 1));
  return grid;
}

/// 1 in a ball in the middle, 0 around it.
std::vector<float> MakeImportance(const limpid::Grid& grid)
{
  std::vector<float> importance;
  for (int k = 0; k < grid.nodes.z; ++k)
  {
    for (int j = 0; j < grid.nodes.y; ++j)
    {
      for (int i = 0; i < grid.nodes.x; ++i)
      {
        const limpid::Vec3 point = grid.PointToWorld({ i, j, k });
        importance.push_back(glm::length(point) < 0.3 ? 1.0f : 0.0f);
      }
    }
  }
  return importance;
}
}

int main()
{
  try
  {
    limpid::SceneFields scene;
    scene.grid = MakeGrid(48);
    const std::vector<float> fog(scene.grid.NodeCount(), 3.0f); // [1/length]
    const std::vector<float> importance = MakeImportance(scene.grid);
    scene.baseExtinction = fog.data();
    scene.importance = importance.data();
    limpid::Camera camera;
    camera.position = { 1.0, 2.0, 4.0 };
    limpid::Light light;
    light.position = { -2.0, 5.0, 3.0 };

    limpid::Solver solver(scene, camera, light, limpid::Settings());
    solver.Run();

    std::cout << std::fixed << std::setprecision(1)
              << "Visible: " << 100 * solver.BestScore().fraction
              << " % of the important structures, " << 100 * solver.BaseScore().fraction
              << " % before\n"
              << solver.Iterations() << " iterations on " << solver.BackendName() << '\n';
    return EXIT_SUCCESS;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
