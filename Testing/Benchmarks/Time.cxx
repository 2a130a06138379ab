// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Time.h"

#include "Markdown.h"
#include "Timing.h"

#include "backend/Backend.h"

#include <algorithm>

namespace limpid::benchmark
{
namespace
{
Settings DefaultSettings(bool skip)
{
  Settings settings;
  settings.skipUnneeded = skip;
  return settings;
}

void WarmUp(const Scene& scene, bool skip)
{
  scene.MakeSolver(DefaultSettings(skip)).Step(2);
}

/// Runs to the end; `iterations` becomes the number of iterations.
RunTimes TimeRun(const Scene& scene, bool skip, int& iterations)
{
  RunTimes times;
  Stopwatch watch;
  Solver solver = scene.MakeSolver(DefaultSettings(skip));
  times.setup = watch.Lap();
  bool done = solver.Step(1);
  times.first = watch.Lap();
  times.ready = times.whole = times.setup + times.first;
  std::vector<double> later;
  while (!done)
  {
    done = solver.Step(1);
    later.push_back(watch.Lap());
    times.whole += later.back();
  }
  times.later = Median(later);
  iterations = solver.Iterations();
  return times;
}

double MedianOf(const std::vector<RunTimes>& runs, double RunTimes::*part)
{
  std::vector<double> values;
  for (const RunTimes& run : runs)
  {
    values.push_back(run.*part);
  }
  return Median(values);
}

RunTimes Medians(const std::vector<RunTimes>& runs)
{
  RunTimes medians;
  for (double RunTimes::*part :
    { &RunTimes::setup, &RunTimes::first, &RunTimes::ready, &RunTimes::later, &RunTimes::whole })
  {
    medians.*part = MedianOf(runs, part);
  }
  return medians;
}

double SpreadOfWhole(const std::vector<RunTimes>& runs)
{
  std::vector<double> values;
  for (const RunTimes& run : runs)
  {
    values.push_back(run.whole);
  }
  return Spread(values);
}

/// The load before the start says nothing about what others do meanwhile; the spread does.
void WarnOfNoise(std::ostream& stream, const std::vector<TimeResult>& results)
{
  const bool noisy = std::any_of(
    results.begin(), results.end(), [](const TimeResult& result) { return result.spread > 0.2; });
  if (noisy)
  {
    stream << "**The machine was busy while this was measured (a spread above 20 %): all times are "
              "preliminary.**\n\n";
  }
}

void WriteDefaults(std::ostream& stream, const std::vector<TimeResult>& results)
{
  Table table({ "scene", "voxels", "setup [ms]", "first pass [ms]", "setup + first pass [ms]",
    "later iteration [ms]", "iterations", "whole run [s]", "spread" });
  for (const TimeResult& result : results)
  {
    const RunTimes& times = result.withSkips;
    table.Add(
      { result.scene, Sizes(result.nodes), Milliseconds(times.setup), Milliseconds(times.first),
        Milliseconds(times.ready), Milliseconds(times.later), std::to_string(result.iterations),
        Significant(times.whole, 3), Fixed(100 * result.spread, 0) + " %" });
  }
  table.Write(stream);
}

void WriteSkips(std::ostream& stream, const std::vector<TimeResult>& results)
{
  Table table({ "scene", "setup + first pass [ms]: on", "off", "off / on",
    "later iteration [ms]: on", "off", "off / on", "whole run [s]: on", "off", "off / on" });
  for (const TimeResult& result : results)
  {
    const RunTimes& on = result.withSkips;
    const RunTimes& off = result.withoutSkips;
    table.Add({ result.scene, Milliseconds(on.ready), Milliseconds(off.ready),
      Fixed(off.ready / on.ready, 2), Milliseconds(on.later), Milliseconds(off.later),
      Fixed(off.later / on.later, 2), Significant(on.whole, 3), Significant(off.whole, 3),
      Fixed(off.whole / on.whole, 2) });
  }
  stream << "### With and without leaving out what is not needed\n";
  table.Write(stream);
}
}

TimeResult MeasureTime(const Scene& scene, const Options& options)
{
  TimeResult result;
  result.scene = scene.file.name;
  result.nodes = scene.grid.nodes;
  WarmUp(scene, true);
  WarmUp(scene, false);
  std::vector<RunTimes> on;
  std::vector<RunTimes> off;
  for (int repeat = 0; repeat < options.repeats; ++repeat)
  {
    int iterationsWithoutSkips = 0;
    on.push_back(TimeRun(scene, true, result.iterations));
    off.push_back(TimeRun(scene, false, iterationsWithoutSkips));
  }
  result.withSkips = Medians(on);
  result.withoutSkips = Medians(off);
  result.spread = SpreadOfWhole(on);
  return result;
}

void WriteTime(std::ostream& stream, const std::vector<TimeResult>& results, const Options& options)
{
  stream << "\n## Time\n\n"
         << "Policy, default settings, camera and light, " << ThreadCount() << " threads. Wall "
         << "time, medians of " << options.repeats
         << " runs with skips on and off in turns, after a warm-up of each. Setup ends with score "
            "and energy of the base extinction. Spread: slowest less fastest whole run over the "
            "median; much more than 10 % means that the machine was busy.\n";
  WriteDefaults(stream, results);
  WarnOfNoise(stream, results);
  WriteSkips(stream, results);
}
}
