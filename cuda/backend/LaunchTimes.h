// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_LaunchTimes_h
#define limpid_backend_LaunchTimes_h

#include <algorithm>
#include <string>
#include <vector>

namespace limpid
{
/// A description of a device operation.
struct Launch
{
  const char* label; ///< a string of static lifetime
  double bytes = 0;  ///< number of bytes copied
  int waits = 0;     ///< number of synchronisations of all threads
};

/// Durations of device operations by label, recorded while timing was on (HostDevice::Time,
/// CudaDevice::Time). For benchmarks.
class LaunchTimes
{
public:
  struct Entry
  {
    std::string label;
    int count = 0;      ///< number of launches or copies
    double seconds = 0; ///< total duration
    double bytes = 0;   ///< total bytes copied
    double waits = 0;   ///< total synchronisations of all threads
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

  /// In the order of first occurrence.
  const std::vector<Entry>& Entries() const { return this->Labels; }

private:
  std::vector<Entry> Labels;
};
}

#endif
