// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Memory.h"

#include "Markdown.h"
#include "Scene.h"

#include "backend/Backend.h"
#include "math/Require.h"

#include <algorithm>
#include <array>
#include <exception>
#include <fstream>
#include <iostream>
#include <memory>

#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

namespace limpid::benchmark
{
namespace
{
struct Usage
{
  double voxels = 0;
  double bytes = 0;
};

/// A line of /proc/self/status, such as "VmHWM:   1234 kB" [byte].
double Resident(const std::string& key)
{
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
  {
    if (line.rfind(key + ":", 0) == 0)
    {
      return 1024 * std::stod(line.substr(key.size() + 1));
    }
  }
  LIMPID_REQUIRE(false,
    "/proc/self/status has no " << key
                                << " (the peak of the memory is read there). Leave the part "
                                   "\"memory\" out.");
  return 0;
}

/// Gives back what the heap does not use and forgets the peak so far.
void ForgetPeak()
{
  malloc_trim(0);
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  LIMPID_REQUIRE(file.good(),
    "/proc/self/clear_refs cannot be written (the peak of reading the scene would count). Leave "
    "the part \"memory\" out.");
}

Usage UsageOfRun(const std::string& scenePath, const Settings& settings, int threads)
{
  Scene scene(scenePath);
  scene.file.scalars = std::vector<double>(); // the solver has never heard of them
  const auto limit = threads > 0 ? std::make_unique<ThreadLimit>(threads) : nullptr;
  ForgetPeak();
  const double before = Resident("VmRSS");
  Solver solver = scene.MakeSolver(settings);
  solver.Run();
  return { double(scene.grid.NodeCount()), Resident("VmHWM") - before };
}

/// In the child: measures and tells the parent. Does not return.
[[noreturn]] void Tell(
  int pipe, const std::string& scenePath, const Settings& settings, int threads)
{
  int status = 1;
  try
  {
    const Usage usage = UsageOfRun(scenePath, settings, threads);
    const bool told = write(pipe, &usage, sizeof(usage)) == ssize_t(sizeof(usage));
    status = told ? 0 : 1;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << std::endl;
  }
  _exit(status);
}

Usage UsageInChild(const std::string& scenePath, const Settings& settings, int threads)
{
  std::array<int, 2> ends{};
  LIMPID_REQUIRE(pipe(ends.data()) == 0,
    "No pipe could be opened (a child process tells its memory through it). Leave the part "
    "\"memory\" out.");
  const pid_t child = fork();
  if (child == 0)
  {
    Tell(ends[1], scenePath, settings, threads);
  }
  close(ends[1]);
  Usage usage;
  const bool heard = child > 0 && read(ends[0], &usage, sizeof(usage)) == ssize_t(sizeof(usage));
  close(ends[0]);
  int status = 1;
  const bool ended = child > 0 && waitpid(child, &status, 0) == child && status == 0;
  LIMPID_REQUIRE(heard && ended,
    "The child process for " << scenePath << " ended with status " << status
                             << " (it measures memory). Leave the part \"memory\" out.");
  return usage;
}

std::string PerVoxel(double bytes, double voxels)
{
  return Fixed(bytes / voxels, 1);
}
}

MemoryResult MeasureMemory(const std::string& scenePath, int threads)
{
  Settings policy;
  Settings separate;
  separate.mode = Mode::Separate;
  Settings adam;
  adam.solver = SolverKind::Adam;
  adam.iterationsPerLevel = { { 2, 2, 2 } }; // all arrays are there after one
  MemoryResult result;
  const std::size_t slash = scenePath.find_last_of('/');
  const std::string file = slash == std::string::npos ? scenePath : scenePath.substr(slash + 1);
  result.scene = file.substr(0, file.find('.'));
  const Usage usage = UsageInChild(scenePath, policy, threads);
  result.voxels = usage.voxels;
  result.policy = usage.bytes;
  result.separate = UsageInChild(scenePath, separate, threads).bytes;
  result.adam = UsageInChild(scenePath, adam, threads).bytes;
  return result;
}

void WriteMemory(std::ostream& stream, const std::vector<MemoryResult>& results)
{
  Table table({ "scene", "voxels", "policy [MiB]", "policy [byte/voxel]",
    "policy, separate [byte/voxel]", "Adam [byte/voxel]" });
  for (const MemoryResult& result : results)
  {
    table.Add({ result.scene, Fixed(result.voxels, 0), Fixed(result.policy / 1048576, 1),
      PerVoxel(result.policy, result.voxels), PerVoxel(result.separate, result.voxels),
      PerVoxel(result.adam, result.voxels) });
  }
  stream << "\n## Memory\n\n"
         << "Peak resident memory of a run to the end, from the solver's constructor on, less what "
            "was resident before: the input's two arrays are not in it, the result is. Each "
            "run has a process of its own, forked before any threads are started, that reads "
            "the scene, gives free memory back (malloc_trim), resets the peak "
            "(/proc/self/clear_refs) and in the end reads VmHWM less the earlier VmRSS from "
            "/proc/self/status. Stacks of threads and freshly used pages of libraries count, "
            "which shows in small scenes. Policy: default settings; Adam: two iterations per "
            "level.\n";
  table.Write(stream);
}
}
