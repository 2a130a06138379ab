// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How good, how fast and how large: the solvers on scene files, as one Markdown page.

#include "AgainstPaper.h"
#include "Machine.h"
#include "Memory.h"
#include "Options.h"
#include "Quality.h"
#include "Scene.h"
#include "Time.h"

#include "backend/Backend.h"
#include "math/Require.h"

#include <exception>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
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

/// Now rather than after minutes of measuring.
void RequireWritable(const std::string& path)
{
  LIMPID_REQUIRE(path.empty() || std::ofstream(path, std::ios::app).good(),
    "The file " << path << " cannot be written (the results would be lost). Choose another.");
}
}

int main(int argc, char* argv[])
{
  try
  {
    const double load = LoadAverage();
    const Options options = ParseOptions(std::vector<std::string>(argv + 1, argv + argc));
    RequireWritable(options.output);
    const Results results = Measure(options);
    const ThreadLimit limit(options.threads > 0 ? options.threads : ThreadCount());
    std::ostringstream page;
    page << "# Solvers\n\nWhat the tables mean is in [README.md](README.md).\n\n";
    WriteMachine(page, std::vector<std::string>(argv, argv + argc), load);
    Write(page, results, options);
    std::ofstream file;
    if (!options.output.empty())
    {
      file.open(options.output);
    }
    (options.output.empty() ? std::cout : file) << page.str() << std::flush;
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
