// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How good, how fast and how large: the solvers on scene files, as one Markdown page.

#include "AgainstPaper.h"
#include "Memory.h"
#include "Program.h"
#include "Quality.h"
#include "Scene.h"
#include "Time.h"

#include "backend/Backend.h"

#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace
{
using namespace limpid;
using namespace limpid::benchmark;

struct Results
{
  std::vector<MemoryResult> memory;
  std::vector<QualityResult> quality;
  std::vector<TimeResult> time;
  std::vector<PaperResult> paper;
};

void Say(const std::string& scene, const char* part)
{
  std::cerr << scene << ": " << part << std::endl;
}

void MeasureScene(const std::string& path, const Options& options, Results& results)
{
  const Scene scene(path);
  if (options.Wants("quality"))
  {
    Say(scene.file.name, "policy against Adam");
    results.quality.push_back(MeasureQuality(scene, options));
  }
  if (options.Wants("time"))
  {
    Say(scene.file.name, "time");
    results.time.push_back(MeasureTime(scene, options));
  }
  if (options.Wants("paper"))
  {
    Say(scene.file.name, "the paper's scheme");
    results.paper.push_back(MeasureAgainstPaper(scene, options));
  }
}

/// Memory first: its child processes must not inherit a process with threads.
Results Measure(const Options& options)
{
  Results results;
  if (options.Wants("memory"))
  {
    for (const std::string& path : options.scenes)
    {
      Say(path, "memory");
      results.memory.push_back(MeasureMemory(path, options.threads));
    }
  }
  const ThreadLimit limit(options.threads > 0 ? options.threads : ThreadCount());
  for (const std::string& path : options.scenes)
  {
    MeasureScene(path, options, results);
  }
  return results;
}

void Write(std::ostream& stream, const Results& results, const Options& options)
{
  if (!results.quality.empty())
  {
    WriteQuality(stream, results.quality, options);
  }
  if (!results.time.empty())
  {
    WriteTime(stream, results.time, options);
  }
  if (!results.paper.empty())
  {
    WriteAgainstPaper(stream, results.paper, options);
  }
  if (!results.memory.empty())
  {
    WriteMemory(stream, results.memory);
  }
}
}

int main(int argc, char* argv[])
{
  return RunProgram(argc, argv, "Solvers",
    [](const Options& options, std::ostream& tables) { Write(tables, Measure(options), options); });
}
