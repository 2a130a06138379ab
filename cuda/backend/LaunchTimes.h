// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_LaunchTimes_h
#define limpid_backend_LaunchTimes_h

#include <algorithm>
#include <string>
#include <vector>

namespace limpid
{
/// What a device is told to do.
struct Launch
{
  const char* label; ///< lives for ever
  double bytes = 0;  ///< that are copied
  int waits = 0;     ///< of all threads for each other
};

/// How long what a device did took, label by label, while it was told to keep the time
/// (HostDevice::Time, CudaDevice::Time). For benchmarks.
class LaunchTimes
{
public:
  struct Entry
  {
    std::string label;
    int count = 0;      ///< launches, or copies
    double seconds = 0; ///< of all of them
    double bytes = 0;   ///< that were copied
    double waits = 0;   ///< of all threads of a launch for each other
  };

  void Add(const Launch& launch, double seconds)
  {
    const auto found = std::find_if(this->Labels.begin(), this->Labels.end(),
      [&](const Entry& entry) { return entry.label == launch.label; });
    Entry& entry =
      found == this->Labels.end() ? this->Labels.emplace_back(Entry{ launch.label }) : *found;
    ++entry.count;
    entry.seconds += seconds;
    entry.bytes += launch.bytes;
    entry.waits += launch.waits;
  }

  /// In the order in which they came first.
  const std::vector<Entry>& Entries() const { return this->Labels; }

private:
  std::vector<Entry> Labels;
};
}

#endif
