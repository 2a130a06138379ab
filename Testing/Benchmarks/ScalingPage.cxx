// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Markdown.h"
#include "ScalingResults.h"

#include "backend/Backend.h"

#include <algorithm>

namespace limpid::benchmark
{
namespace
{
std::string Percent(double share, int decimals = 0)
{
  return Fixed(100 * share, decimals) + " %";
}

std::string SpreadOf(const StepResult& times)
{
  return Percent(times.spread[Step::Iteration]);
}

std::vector<std::string> Headings(
  const std::vector<std::string>& before, const std::string& unit, const std::string& after)
{
  std::vector<std::string> headings = before;
  for (const Step step : allSteps)
  {
    headings.push_back(NameOf(step) + unit);
  }
  if (!after.empty())
  {
    headings.push_back(after);
  }
  return headings;
}

void WriteSizes(std::ostream& stream, const ScalingResults& results, int repeats)
{
  stream << "\n## Time against voxels\n\n"
         << "Medians of " << repeats
         << " rounds through all sizes (of three at most from 300³ on), " << ThreadCount()
         << " threads, wall time. Policy iteration (from the third on) and Adam iteration: camera "
            "and light at full resolution. Score: one of several directions. Spread: slowest less "
            "fastest policy "
            "iteration over the median.\n";
  Table table(Headings({ "scene", "nodes" }, " [ms]", "spread"));
  for (const SizeResult& size : results.sizes)
  {
    std::vector<std::string> row{ size.scene, std::to_string(size.side) + "³" };
    for (const Step step : allSteps)
    {
      const double seconds = size.times.seconds[step];
      row.push_back(seconds > 0 ? Milliseconds(seconds) : "");
    }
    row.push_back(SpreadOf(size.times));
    table.Add(row);
  }
  table.Write(stream);
  stream << "Exponent e of time ∝ voxels^e, least squares in the logarithms, sizes from 64³ on:\n";
  Table fits(Headings({ "scene", "sizes" }, "", ""));
  for (const Exponents& fit : results.exponents)
  {
    std::vector<std::string> row{ fit.scene,
      std::to_string(fit.smallest) + "³ … " + std::to_string(fit.largest) + "³" };
    for (const Step step : allSteps)
    {
      row.push_back(fit.values[step] > 0 ? Fixed(fit.values[step], 3) : "");
    }
    fits.Add(row);
  }
  fits.Write(stream);
}

void WriteMemory(std::ostream& stream, const std::vector<VolumeMemory>& memory)
{
  stream << "\n## Memory against voxels\n\n"
         << "Peak resident memory of a default run to the end (policy, camera and light), from the "
            "solver's constructor on, less what was resident before: the input's two arrays (8 "
            "bytes a voxel) are not in it, the result is. Every run has a process of its own.\n";
  Table table({ "scene", "nodes", "beyond the input [MiB]", "[byte/voxel]" });
  for (const VolumeMemory& volume : memory)
  {
    table.Add({ volume.scene, std::to_string(volume.side) + "³",
      Fixed(volume.usage.bytes / 1048576, 1), Fixed(volume.usage.bytes / volume.usage.voxels, 1) });
  }
  table.Write(stream);
}

void WriteThreads(std::ostream& stream, const std::vector<ThreadResult>& results, int repeats)
{
  stream << "\n## Threads\n\n"
         << "Medians of " << repeats
         << " rounds, numbers of threads in turns in one process, wall time. Efficiency: time on "
            "one thread over the product of threads and time on all. Cores: the same for plain "
            "arithmetic, times the threads: what the machine lent meanwhile.\n";
  Table table(Headings({ "scene", "nodes", "threads" }, " [ms]", "spread"));
  Table shares(Headings({ "scene", "threads" }, "", "cores"));
  for (const ThreadResult& result : results)
  {
    for (std::size_t i = 0; i < result.threads.size(); ++i)
    {
      std::vector<std::string> row{ result.scene, Sizes(result.nodes),
        std::to_string(result.threads[i]) };
      for (const Step step : allSteps)
      {
        row.push_back(Milliseconds(result.times[i].seconds[step]));
      }
      row.push_back(SpreadOf(result.times[i]));
      table.Add(row);
    }
    std::vector<std::string> row{ result.scene, std::to_string(result.threads.back()) };
    for (const Step step : allSteps)
    {
      row.push_back(Percent(result.Efficiency(step)));
    }
    row.push_back(Fixed(result.cores, 2));
    shares.Add(row);
  }
  table.Write(stream);
  stream << "Parallel efficiency:\n";
  shares.Write(stream);
}

void WriteSkips(std::ostream& stream, const std::vector<SkipResult>& results, int repeats)
{
  stream
    << "\n## What is left out, and the time that it saves\n\n"
    << "Counted in the plans of the sweeps. Voxels: nodes that no ray of camera or light reads "
       "and no iteration can change. Samples: rays times layers, against the same with "
       "SkipUnneeded off.\n";
  Table counts({ "scene", "not empty", "read by camera", "read by light", "voxels skipped",
    "samples, camera [10⁶]: taken", "all", "skipped", "samples, light [10⁶]: taken", "all",
    "skipped", "samples skipped" });
  Table times({ "scene", "iteration [ms]: on", "off", "off / on", "setup + first pass [ms]: on",
    "off", "off / on", "whole run [s]: on", "off", "off / on", "spread" });
  for (const SkipResult& result : results)
  {
    const auto share = [&](double nodes) { return Percent(nodes / result.voxels, 1); };
    counts.Add(
      { result.scene, share(result.filled), share(result.seenByCamera), share(result.seenByLight),
        Percent(result.VoxelsSkipped(), 1), Significant(result.camera.taken / 1e6, 3),
        Significant(result.camera.all / 1e6, 3), Percent(result.camera.Skipped(), 1),
        Significant(result.light.taken / 1e6, 3), Significant(result.light.all / 1e6, 3),
        Percent(result.light.Skipped(), 1), Percent(result.SamplesSkipped(), 1) });
    const RunTimes& on = result.time.withSkips;
    const RunTimes& off = result.time.withoutSkips;
    times.Add({ result.scene, Milliseconds(on.later), Milliseconds(off.later),
      Fixed(off.later / on.later, 2), Milliseconds(on.ready), Milliseconds(off.ready),
      Fixed(off.ready / on.ready, 2), Significant(on.whole, 3), Significant(off.whole, 3),
      Fixed(off.whole / on.whole, 2), Percent(result.time.spread) });
  }
  counts.Write(stream);
  stream << "Default runs to the end with skips on and off in turns, " << ThreadCount()
         << " threads, medians of " << repeats << ", after a warm-up of each:\n";
  times.Write(stream);
}

bool IsNoisy(const ScalingResults& results)
{
  constexpr double most = 0.25;
  return std::any_of(results.sizes.begin(), results.sizes.end(),
           [](const SizeResult& size)
           { return size.side >= 128 && size.times.spread[Step::Iteration] > most; }) ||
    std::any_of(results.threads.begin(), results.threads.end(),
      [](const ThreadResult& result) { return result.cores < 0.9 * result.threads.back(); }) ||
    std::any_of(results.skips.begin(), results.skips.end(),
      [](const SkipResult& result) { return result.time.spread > most; });
}
}

void WriteScaling(std::ostream& stream, const ScalingResults& results, const Options& options)
{
  stream << "\nLoad average at the end: " << Fixed(results.loadAfter, 2)
         << ", this program included.\n\n"
         << "onion: a core in a shell, the corners of the box are empty; dense: the same in a haze "
            "that leaves nothing empty. The core is important. Skips off: whatever the scene does "
            "not need is computed, too, as if everything were important.\n";
  if (IsNoisy(results))
  {
    stream << "\n**The machine was busy while this was measured (a spread above 25 %, or fewer "
              "cores than threads): all times are preliminary.**\n";
  }
  if (!results.sizes.empty())
  {
    WriteSizes(stream, results, options.repeats);
  }
  if (!results.memory.empty())
  {
    WriteMemory(stream, results.memory);
  }
  if (!results.threads.empty())
  {
    WriteThreads(stream, results.threads, options.repeats);
  }
  if (!results.skips.empty())
  {
    WriteSkips(stream, results.skips, options.repeats);
  }
}
}
