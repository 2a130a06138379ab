// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/PhysicalMemory.h"

#include <limits>

#if defined(__linux__)
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#endif

namespace limpid
{
namespace
{
constexpr double unlimited = std::numeric_limits<double>::infinity();

#if defined(__linux__)
/// Returns the number in a file; infinite if there is none.
double NumberIn(const std::string& path)
{
  double number = unlimited;
  return std::ifstream(path) >> number ? number : unlimited;
}

/// Returns the number that follows a word in a file, or `otherwise`.
double NumberAfter(const std::string& path, const std::string& word, double otherwise)
{
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line))
  {
    std::istringstream words(line);
    std::string first;
    double number = 0;
    if (words >> first >> number && first == word)
    {
      return number;
    }
  }
  return otherwise;
}

/// What a control group leaves, given the names of its files. Cached files can be dropped.
double LeftBy(const std::string& folder, const char* limit, const char* used, const char* cached)
{
  const double most = NumberIn(folder + limit);
  const double taken = NumberIn(folder + used);
  const double dropped = NumberAfter(folder + "/memory.stat", cached, 0);
  return most < unlimited && taken < unlimited ? std::max(most - taken + dropped, 0.0) : unlimited;
}

/// What the control groups of this process leave, of both versions. A group's limit holds for all
/// groups in it. In a container, paths may be those outside; the root is its own group there.
double LeftByControlGroups()
{
  double least = unlimited;
  std::ifstream groups("/proc/self/cgroup");
  std::string line;
  while (std::getline(groups, line)) // "4:memory:/user" or "0::/user"
  {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (second == std::string::npos)
    {
      continue;
    }
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool isSecond = controllers.empty();
    if (!isSecond && ("," + controllers + ",").find(",memory,") == std::string::npos)
    {
      continue;
    }
    const std::string root = isSecond ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
    std::string path = line.substr(second + 1);
    while (true)
    {
      const std::string folder = root + path;
      least = std::min(least,
        isSecond ? LeftBy(folder, "/memory.max", "/memory.current", "inactive_file")
                 : LeftBy(folder, "/memory.limit_in_bytes", "/memory.usage_in_bytes",
                     "total_inactive_file"));
      if (path.empty() || path == "/")
      {
        break;
      }
      path.resize(path.rfind('/'));
    }
  }
  return least;
}

double LeftOfAddressSpace()
{
  rlimit limit{};
  const double pages = NumberIn("/proc/self/statm"); // the first is the size of the address space
  const bool isLimited = getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return isLimited && pages < unlimited
    ? std::max(double(limit.rlim_cur) - pages * double(sysconf(_SC_PAGESIZE)), 0.0)
    : unlimited;
}
#endif
}

double PhysicalMemory()
{
#if defined(__linux__)
  const double bytes = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  if (bytes > 0)
  {
    return bytes;
  }
#endif
  return unlimited;
}

double AvailableMemory()
{
#if defined(__linux__)
  constexpr double kibibyte = 1024;
  const double ofMachine =
    kibibyte * NumberAfter("/proc/meminfo", "MemAvailable:", PhysicalMemory() / kibibyte);
  return std::min({ ofMachine, LeftByControlGroups(), LeftOfAddressSpace() });
#else
  return PhysicalMemory();
#endif
}
}
