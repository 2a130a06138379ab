// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Errors.h"

#include "backend/Backend.h"

namespace limpid::benchmark
{
Json MeasureErrors(const SceneOfFile& scene, const Options& options)
{
  Stopwatch watch;
  const auto say = [&](const char* part)
  { Say("  " + std::to_string(int(watch.Elapsed())) + " s: " + part); };
  const CudaState& gpu = FindCuda();
  const Effort effort(options, double(scene.grid.NodeCount()));
  say("reference");
  WholeRun standard;
  standard.settings.backend = BackendKind::Cpu;
  standard.threads = ThreadCount();
  const std::vector<float> optimized = Execute(scene, standard);
  const Truth truth(scene, optimized, effort);
  Json result{ { "name", scene.name }, { "nodes", ToJson(scene.grid.nodes) },
    { "voxels", scene.grid.NodeCount() }, { "reference", truth.Facts() },
    { "cuda", gpu.usable ? "measured" : "not measured: " + gpu.reason } };
  say("sweeps");
  result["sweeps"] = MeasureSweeps(truth, effort);
  result["shadows"] = MeasureShadows(truth, effort);
  result["iterations"] = TimeIterations(scene, effort);
  say("quadrature");
  result["quadratures"] = MeasureQuadratures(truth, effort);
  say("whole runs");
  result["runs"] = MeasureRuns(truth, effort, options);
  say("the paper's grids");
  result["paper_grids"] = MeasureGrids(truth, effort, options);
  result["seconds"] = watch.Elapsed();
  return result;
}
}
