// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Every benchmark reads options, measures, and writes one JSON file with numbers, options and
// machine. The pages are made from these files by Testing/Benchmarks/pages.

#ifndef limpid_testing_benchmarks_Program_h
#define limpid_testing_benchmarks_Program_h

#include "math/Vec.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace limpid::benchmark
{
using Json = nlohmann::ordered_json;

/// Wall clock since its construction or the last Lap().
class Stopwatch
{
public:
  /// Seconds since the last lap; starts the next.
  double Lap()
  {
    const Clock::time_point now = Clock::now();
    const std::chrono::duration<double> seconds = now - this->Start;
    this->Start = now;
    return seconds.count();
  }

  /// Seconds since the last lap, which goes on.
  double Elapsed() const
  {
    return std::chrono::duration<double>(Clock::now() - this->Start).count();
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point Start = Clock::now();
};

/// Middle value, or the mean of the two in the middle; 0 of nothing.
inline double Median(std::vector<double> values)
{
  if (values.empty())
  {
    return 0;
  }
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

/// Range of the values over their median: how quiet the machine was.
inline double Spread(const std::vector<double>& values)
{
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return values.empty() ? 0 : (*most - *least) / Median(values);
}

std::vector<std::string> Split(const std::string& list); ///< items between commas

/// Options of the form --name value, flags of the form --name, and all other words.
class Options
{
public:
  using Table = std::map<std::string, std::string>;

  /// `known`: names and defaults. What has the default "no" is a flag, what has numbers takes
  /// numbers above zero, what has several items takes some of them; commas are between items.
  /// Throws limpid::Error on what it does not understand.
  Options(const std::vector<std::string>& arguments, const Table& known);

  /// Tells which options there are if "--help" is among the arguments. Returns whether it is.
  static bool TellUsage(const std::vector<std::string>& arguments, const Table& known);

  const std::string& Text(const std::string& name) const { return this->Values.at(name); }
  double Number(const std::string& name) const { return std::stod(this->Text(name)); }
  int Count(const std::string& name) const { return static_cast<int>(this->Number(name)); }
  bool Flag(const std::string& name) const { return this->Text(name) == "yes"; }
  std::vector<std::string> List(const std::string& name) const { return Split(this->Text(name)); }
  bool Has(const std::string& name, const std::string& item) const;
  Json ToJson() const;

  std::vector<std::string> words;

private:
  static std::string UsageOf(const Table& known);

  Table Values;
};

/// Median of repeated times [s], their spread and number.
inline Json FigureOf(const std::vector<double>& seconds)
{
  return { { "seconds", Median(seconds) }, { "spread", Spread(seconds) },
    { "repeats", seconds.size() } };
}

/// Times of several rounds by what was timed [s].
using Rounds = std::map<std::string, std::vector<double>>;

/// The medians and the spreads, each by what was timed.
inline Json MediansOf(const Rounds& rounds)
{
  Json result;
  for (const auto& [name, seconds] : rounds)
  {
    result["seconds"][name] = Median(seconds);
    result["spread"][name] = Spread(seconds);
  }
  return result;
}

inline Json ToJson(const Int3& nodes)
{
  return { nodes.x, nodes.y, nodes.z };
}

double LoadAverage(); ///< processes that were running, a mean over the last minute

/// What is measured on and with. Absolute paths in `command` are a matter of one machine: of those
/// only the file name is shown.
Json Machine(const std::vector<std::string>& command, double loadBefore);

/// Fills `results`; may call `save` whenever more of them are there.
using Measurement =
  std::function<void(const Options& options, Json& results, const std::function<void()>& save)>;

/// The main function of a benchmark: writes the results to the file that the option "output" names,
/// or to standard output. The option "threads" limits them. Returns the program's status.
int RunProgram(int argc, char* argv[], const Options::Table& known, const Measurement& measure);
}

#endif
