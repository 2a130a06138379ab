// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How long pictures take, stage by stage.

#ifndef limpid_testing_benchmarks_Rendering_h
#define limpid_testing_benchmarks_Rendering_h

#include "Options.h"
#include "Scene.h"

#include <ostream>
#include <string>
#include <vector>

namespace limpid::benchmark
{
/// Medians over several runs [s].
struct StillTimes
{
  double scalars = 0;   ///< SetScalars: checks, ranges of the bricks
  double functions = 0; ///< SetTransferFunctions and SetExtinction
  double shadow = 0;    ///< shadow volume
  double prepared = 0;  ///< gradient and empty bricks
  double rays = 0;      ///< rays, lit, with shadows
  double spread = 0;    ///< of `rays`: slowest less fastest over the median
};

/// The rays of one picture [s].
struct RayTimes
{
  double samples = 0;    ///< on all rays, from entry to exit
  double emptyShare = 0; ///< of the pixels that see nothing
  double unlit = 0;
  double lit = 0; ///< without shadows
  double shadowed = 0;
  double whole = 0; ///< likewise, but every sample of every ray is taken
};

/// A frame of an orbit: one pass of the optimisation on a coarse grid, a small picture [s].
struct MovingTimes
{
  Int3 nodes{ 0 }; ///< of the grid on which is optimised
  double optimization = 0;
  double shadow = 0;
  double rays = 0;
  double frame = 0;
  double longest = 0;
};

/// As many rays as one sweep from the camera has, one per voxel and axis, by either way [s].
struct FewRaysTimes
{
  Index rays = 0;
  double sweep = 0; ///< integrals of two scalars: fewer than colours, and without light
  double cast = 0;  ///< an unlit picture of as many pixels
};

struct RenderingResult
{
  std::string scene;
  Int3 nodes{ 0 };
  StillTimes still;
  RayTimes base;
  RayTimes optimized;
  MovingTimes moving;
  FewRaysTimes fewRays;
};

RenderingResult MeasureRendering(const Scene& scene, const Options& options);
void WriteRendering(std::ostream& stream, const std::vector<RenderingResult>& results);
}

#endif
