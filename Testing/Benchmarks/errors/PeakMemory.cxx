// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "PeakMemory.h"

#include <algorithm>
#include <fstream>
#include <string>

#include <malloc.h>

namespace limpid::benchmark
{
namespace
{
/// A line of /proc/self/status, such as "VmHWM:   1234 kB" [byte]; 0 if there is none.
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
  return 0;
}
}

PeakMemory::PeakMemory()
{
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5" << std::flush; // forgets the peak so far
  this->Before = Resident("VmRSS");
}

double PeakMemory::Bytes() const
{
  return std::max(0.0, Resident("VmHWM") - this->Before);
}
}
