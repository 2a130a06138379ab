// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "MemoryInChild.h"

#include "math/Require.h"

#include <array>
#include <exception>
#include <fstream>
#include <iostream>

#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

namespace limpid::benchmark
{
namespace
{
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

Usage UsageOf(const std::function<MeasuredRun()>& makeRun)
{
  const MeasuredRun run = makeRun();
  ForgetPeak();
  const double before = Resident("VmRSS");
  const double voxels = run();
  return { voxels, Resident("VmHWM") - before };
}

/// In the child: measures and tells the parent. Does not return.
[[noreturn]] void Tell(int pipe, const std::function<MeasuredRun()>& makeRun)
{
  int status = 1;
  try
  {
    const Usage usage = UsageOf(makeRun);
    const bool told = write(pipe, &usage, sizeof(usage)) == ssize_t(sizeof(usage));
    status = told ? 0 : 1;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << std::endl;
  }
  _exit(status);
}
}

Usage UsageInChild(const std::string& name, const std::function<MeasuredRun()>& makeRun)
{
  std::array<int, 2> ends{};
  LIMPID_REQUIRE(pipe(ends.data()) == 0,
    "No pipe could be opened (a child process tells its memory through it). Leave the part "
    "\"memory\" out.");
  const pid_t child = fork();
  if (child == 0)
  {
    Tell(ends[1], makeRun);
  }
  close(ends[1]);
  Usage usage;
  const bool heard = child > 0 && read(ends[0], &usage, sizeof(usage)) == ssize_t(sizeof(usage));
  close(ends[0]);
  int status = 1;
  const bool ended = child > 0 && waitpid(child, &status, 0) == child && status == 0;
  LIMPID_REQUIRE(heard && ended,
    "The child process for " << name << " ended with status " << status
                             << " (it measures memory). Leave the part \"memory\" out.");
  return usage;
}
}
