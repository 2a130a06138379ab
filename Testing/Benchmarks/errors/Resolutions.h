// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The paper's Fig. 10: resolution of the world against that of the rays, as pictures and numbers.

#ifndef limpid_testing_benchmarks_errors_Resolutions_h
#define limpid_testing_benchmarks_errors_Resolutions_h

#include "../Scene.h"
#include "Results.h"

#include "render/Renderer.h"

#include <string>
#include <vector>

namespace limpid::benchmark
{
/// What one resolution of world and rays leads to.
struct ResolutionResult
{
  WholeRun run;
  Picture picture;
  double difference = 0; ///< rms of the picture's channels from that of the finest [0, 255]
};

/// All resolutions of a scene: coarse to fine nodes, and of each, few to many rays.
struct ResolutionResults
{
  std::string scene;
  std::vector<ResolutionResult> results;
};

/// Pictures of so many pixels along each side.
ResolutionResults MeasureResolutions(const Scene& scene, int repeats, int pixels);
}

#endif
