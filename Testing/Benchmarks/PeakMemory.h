// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Peak resident memory as Linux tells it in /proc.

#ifndef limpid_testing_benchmarks_PeakMemory_h
#define limpid_testing_benchmarks_PeakMemory_h

#include "math/Require.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <string>

#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

namespace limpid::benchmark
{
/// A line of a file, such as "VmHWM:   1234 kB" [byte]; 0 if there is none.
inline double BytesIn(const char* path, const std::string& key)
{
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
  {
    if (line.rfind(key, 0) == 0)
    {
      return 1024 * std::stod(line.substr(key.size()));
    }
  }
  return 0;
}

/// The most memory that this process has had resident since the object was made, beyond what it
/// had then [byte].
class PeakMemory
{
public:
  PeakMemory()
  {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5" << std::flush; // forgets the peak so far
    this->Before = BytesIn("/proc/self/status", "VmRSS:");
  }

  double Bytes() const
  {
    return std::max(0.0, BytesIn("/proc/self/status", "VmHWM:") - this->Before);
  }

private:
  double Before;
};

/// Peak of the function that `prepare` returns, in a process that did nothing but prepare it
/// [byte]. Call it before this process has started threads: children inherit none.
inline double PeakInChild(const std::function<std::function<void()>()>& prepare)
{
  int ends[2] = { -1, -1 };
  double bytes = -1;
  LIMPID_REQUIRE(pipe(ends) == 0, "No pipe could be opened (a child process tells its memory).");
  if (fork() == 0)
  {
    const std::function<void()> run = prepare();
    const PeakMemory memory;
    run();
    bytes = memory.Bytes();
    _exit(write(ends[1], &bytes, sizeof(bytes)) == ssize_t(sizeof(bytes)) ? 0 : 1);
  }
  close(ends[1]);
  const bool heard = read(ends[0], &bytes, sizeof(bytes)) == ssize_t(sizeof(bytes));
  close(ends[0]);
  wait(nullptr);
  LIMPID_REQUIRE(
    heard, "A child process ended early (it measures memory). Leave the part \"memory\" out.");
  return bytes;
}
}

#endif
