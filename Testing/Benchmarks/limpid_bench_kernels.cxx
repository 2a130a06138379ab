// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How fast the loops over rows and the sweeps are, what memory could do, and how far a policy
// iteration is from that.
//
//   limpid_bench_kernels [--output FILE] [--json FILE] [--largest NODES] [--quick] [--repeats N]
//     [--threads N] [NAME.scene.json ...]

#include "KernelsResults.h"
#include "Machine.h"
#include "Program.h"
#include "Scene.h"

#include "GpuScene.h"
#include "backend/Backend.h"
#include "math/Require.h"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <string>

namespace
{
using namespace limpid;
using namespace limpid::benchmark;

void Say(const std::string& text)
{
  std::cerr << text << std::endl;
}

/// On one thread and on all.
void MeasureFloors(const TimedScene& scene, int iterations, KernelsResults& results)
{
  Say("iteration, " + scene.name);
  const int all = ThreadCount();
  for (const int threads : all > 1 ? std::vector<int>{ 1, all } : std::vector<int>{ 1 })
  {
    const ThreadLimit limit(threads);
    results.floors.push_back(MeasureFloor(scene, iterations));
  }
}

KernelsResults Measure(const Options& options)
{
  KernelsResults results;
  results.loadBefore = LoadAverage();
  const int threads = ThreadCount();
  Say("streams");
  results.streams = MeasureBandwidth(threads, options.quick);
  const int side = std::min(256, options.largest);
  const int iterations = options.quick ? 1 : std::max(3, 2 * options.repeats - 1);
  for (const std::string& path : options.scenes)
  {
    const Scene scene(path);
    MeasureFloors(
      { scene.file.name, scene.Fields(), scene.camera, scene.light, true }, iterations, results);
  }
  for (const Filling filling : { Filling::Dense, Filling::Onion })
  {
    const GpuScene scene(filling, side);
    MeasureFloors(SceneOf(scene), iterations, results);
  }
  Say("kernels");
  results.kernels = options.quick ? MeasureKernels({ side, 1, 1e-3 })
                                  : MeasureKernels({ side, options.repeats, 0.1 });
  results.loadAfter = LoadAverage();
  return results;
}
}

int main(int argc, char* argv[])
{
  return RunProgram(argc, argv, "Kernels",
    [](const Options& options, std::ostream& tables)
    {
      const ThreadLimit limit(options.threads > 0 ? options.threads : ThreadCount());
      const KernelsResults results = Measure(options);
      WriteKernels(tables, results);
      if (!options.json.empty())
      {
        std::ofstream json(options.json);
        WriteKernelsJson(json, results);
        LIMPID_REQUIRE(json.flush().good(),
          "The file " << options.json
                      << " cannot be written (no plot could be drawn). Choose another.");
      }
    });
}
