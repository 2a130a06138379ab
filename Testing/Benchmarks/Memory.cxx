// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Memory.h"

#include "Markdown.h"
#include "MemoryInChild.h"
#include "Scene.h"

#include "backend/Backend.h"

#include <memory>

namespace limpid::benchmark
{
namespace
{
Usage UsageOfRun(const std::string& scenePath, const Settings& settings, int threads)
{
  return UsageInChild(scenePath,
    [&]() -> MeasuredRun
    {
      const auto scene = std::make_shared<Scene>(scenePath);
      scene->file.scalars = std::vector<double>(); // the solver has never heard of them
      return [=]
      {
        const ThreadLimit limit(threads > 0 ? threads : ThreadCount());
        Solver solver = scene->MakeSolver(settings);
        solver.Run();
        return double(scene->grid.NodeCount());
      };
    });
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
  const Usage usage = UsageOfRun(scenePath, policy, threads);
  result.voxels = usage.voxels;
  result.policy = usage.bytes;
  result.separate = UsageOfRun(scenePath, separate, threads).bytes;
  result.adam = UsageOfRun(scenePath, adam, threads).bytes;
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
