// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How time and memory grow with voxels, how they shrink with threads, and what skipping saves.
//
//   limpid_bench_scaling [--output FILE] [--json FILE] [--parts memory,sizes,threads,skips]
//     [--largest NODES] [--repeats N] [--threads N] [NAME.scene.json ...]

#include "Machine.h"
#include "Program.h"
#include "ScalingResults.h"

#include "backend/Backend.h"
#include "math/Require.h"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

namespace
{
using namespace limpid;
using namespace limpid::benchmark;

void Say(const std::string& text)
{
  std::cerr << text << std::endl;
}

/// Nodes along each axis of the volumes that are wanted and fit.
std::vector<int> SidesOf(const Options& options)
{
  const int fits = LargestThatFits();
  std::vector<int> sides;
  for (const int side : { 32, 64, 96, 128, 192, 256, 384, 512 })
  {
    if (side <= options.largest && side > fits)
    {
      Say(
        std::to_string(side) + "³ is left out: there is memory for " + std::to_string(fits) + "³");
    }
    else if (side <= options.largest)
    {
      sides.push_back(side);
    }
  }
  LIMPID_REQUIRE(!sides.empty(),
    "The largest volume may have " << options.largest << " nodes along each axis, and memory is "
                                   << "left for " << fits
                                   << " (the smallest one has 32). Give --largest 32 or more.");
  return sides;
}

std::vector<Series> SeriesOf(const std::vector<int>& sides)
{
  std::vector<int> fitted; // of the time without skips, only the exponent matters
  std::copy_if(sides.begin(), sides.end(), std::back_inserter(fitted),
    [](int side) { return side >= smallestFitted; });
  std::vector<Series> series{ { Filling::Dense, true, sides }, { Filling::Onion, true, sides } };
  if (!fitted.empty())
  {
    series.push_back({ Filling::Dense, false, fitted });
  }
  return series;
}

Usage UsageOfVolume(Filling filling, int side, int threads)
{
  return UsageInChild(NameOf(filling) + " " + std::to_string(side),
    [=]() -> MeasuredRun
    {
      const auto scene = std::make_shared<GpuScene>(filling, side);
      return [=]
      {
        const ThreadLimit limit(threads > 0 ? threads : ThreadCount());
        Settings settings;
        settings.backend = BackendKind::Cpu;
        Solver solver(scene->Fields(), scene->camera, scene->light, settings);
        solver.Run();
        return double(scene->grid.NodeCount());
      };
    });
}

void MeasureVolumes(const Options& options, const std::vector<int>& sides, ScalingResults& results)
{
  for (const Series& series : SeriesOf(sides))
  {
    const std::vector<SizeResult> sizes = MeasureSizes(series, options.repeats, Say);
    results.exponents.push_back(FitExponents(series.Name(), sizes));
    results.sizes.insert(results.sizes.end(), sizes.begin(), sizes.end());
  }
}

void MeasureThreadsOfAll(
  const Options& options, const std::vector<int>& sides, ScalingResults& results)
{
  const int all = ThreadCount();
  for (const Filling filling : { Filling::Dense, Filling::Onion })
  {
    Say("threads, " + NameOf(filling));
    const GpuScene scene(filling, std::min(256, sides.back()));
    results.threads.push_back(MeasureThreads(SceneOf(scene), all, options.repeats));
  }
  for (const std::string& path : options.scenes)
  {
    const Scene scene(path);
    Say("threads, " + scene.file.name);
    results.threads.push_back(MeasureThreads(
      { scene.file.name, scene.Fields(), scene.camera, scene.light }, all, options.repeats));
  }
}

/// Memory first: its child processes must not inherit a process with threads.
ScalingResults Measure(const Options& options)
{
  ScalingResults results;
  results.loadBefore = LoadAverage();
  const std::vector<int> sides = SidesOf(options);
  if (options.Wants("memory"))
  {
    for (const Filling filling : { Filling::Dense, Filling::Onion })
    {
      Say("memory, " + NameOf(filling));
      for (const int side : sides)
      {
        results.memory.push_back(
          { NameOf(filling), side, UsageOfVolume(filling, side, options.threads) });
      }
    }
  }
  const ThreadLimit limit(options.threads > 0 ? options.threads : ThreadCount());
  if (options.Wants("sizes"))
  {
    MeasureVolumes(options, sides, results);
  }
  if (options.Wants("threads"))
  {
    MeasureThreadsOfAll(options, sides, results);
  }
  if (options.Wants("skips"))
  {
    for (const std::string& path : options.scenes)
    {
      const Scene scene(path);
      Say("skips, " + scene.file.name);
      results.skips.push_back(MeasureSkips(scene, options));
    }
  }
  results.loadAfter = LoadAverage();
  return results;
}
}

int main(int argc, char* argv[])
{
  return RunProgram(argc, argv, "Scaling",
    [](const Options& options, std::ostream& tables)
    {
      const ScalingResults results = Measure(options);
      const ThreadLimit limit(options.threads > 0 ? options.threads : ThreadCount());
      WriteScaling(tables, results, options);
      if (!options.json.empty())
      {
        std::ofstream json(options.json);
        WriteScalingJson(json, results);
        LIMPID_REQUIRE(json.flush().good(),
          "The file " << options.json
                      << " cannot be written (no plot could be drawn). Choose another.");
      }
    });
}
