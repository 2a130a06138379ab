// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Run time against error, setting by setting: a Markdown page, and JSON for the plots.

#include "../Machine.h"
#include "../Program.h"
#include "../Timing.h"
#include "Fronts.h"
#include "Grids.h"
#include "Json.h"
#include "Page.h"
#include "Quadrature.h"
#include "Runs.h"
#include "Sweeps.h"
#include "Truth.h"

#include "backend/Backend.h"
#include "math/Require.h"

#include <fstream>
#include <iostream>

namespace
{
using namespace limpid;
using namespace limpid::benchmark;

void Say(const SceneResult& scene, const Stopwatch& watch, const char* part)
{
  std::cerr << scene.name << ", " << static_cast<int>(watch.Elapsed()) << " s: " << part
            << std::endl;
}

SceneResult MeasureScene(const std::string& path, const Options& options)
{
  Stopwatch watch;
  const Scene scene(path);
  SceneResult result;
  result.name = scene.file.name;
  result.nodes = { scene.grid.nodes.x, scene.grid.nodes.y, scene.grid.nodes.z };
  result.voxels = double(scene.grid.NodeCount());
  const Effort effort(options, result.voxels);
  Say(result, watch, "reference");
  const std::vector<float> optimized = DefaultResult(scene);
  const Truth truth(scene, optimized, effort);
  result.reference = truth.Facts();
  Say(result, watch, "sweeps");
  result.sweeps = MeasureSweeps(truth, effort);
  result.shadows = MeasureShadows(truth, effort);
  result.iterations = TimeIterations(scene, effort);
  Say(result, watch, "quadrature");
  result.quadratures = MeasureQuadratures(truth, effort);
  Say(result, watch, "whole runs");
  result.runs = MeasureRuns(truth, options, effort);
  Say(result, watch, "the paper's grids");
  result.grids = MeasureGrids(truth, effort, options);
  result.fronts = FrontsOf(result);
  result.equal = EqualErrorsOf(result);
  result.seconds = watch.Elapsed();
  Say(result, watch, "done");
  return result;
}

void Measure(const Options& options, std::ostream& page)
{
  const double load = LoadAverage();
  std::ofstream json;
  if (!options.json.empty())
  {
    json.open(options.json);
    LIMPID_REQUIRE(json.good(),
      "The file " << options.json << " cannot be written (the plots need it). Choose another.");
  }
  const CudaState& gpu = FindCuda();
  const std::string cuda = gpu.usable ? "" : gpu.reason;
  const ThreadLimit limit(options.threads > 0 ? options.threads : ThreadCount());
  std::vector<SceneResult> scenes;
  for (const std::string& path : options.scenes)
  {
    scenes.push_back(MeasureScene(path, options));
  }
  WritePage(page, scenes, cuda);
  if (json.is_open())
  {
    WriteJson(json, scenes, load, cuda.empty() ? "measured" : "not measured: " + cuda);
  }
}
}

int main(int argc, char* argv[])
{
  return RunProgram(argc, argv, "Run time against error", Measure);
}
