// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Volumes of any size to measure with.

#ifndef limpid_testing_gpu_GpuScene_h
#define limpid_testing_gpu_GpuScene_h

#include "optimize/Solver.h"

#include <string>
#include <vector>

namespace limpid::benchmark
{
enum class Filling
{
  Onion, ///< a core in a shell; the corners of the box are empty
  Dense  ///< the same in a haze that leaves nothing empty
};

std::string NameOf(Filling filling);

/// [-1, 1]^3 with an important core inside a shell that hides it, seen obliquely from outside and
/// lit from above.
struct GpuScene
{
  GpuScene(Filling filling, int nodes);

  SceneFields Fields() const
  {
    return { this->grid, this->extinction.data(), this->importance.data() };
  }

  std::string name;
  Grid grid;
  std::vector<float> extinction;
  std::vector<float> importance;
  float largest = 0; ///< extinction [1/length]
  Camera camera;
  Light light;
};
}

#endif
