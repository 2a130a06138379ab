// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_benchmarks_Machine_h
#define limpid_testing_benchmarks_Machine_h

#include <ostream>
#include <string>
#include <vector>

namespace limpid::benchmark
{
/// Processes that were running when the program started, a mean over the last minute; below zero
/// if the system does not tell.
double LoadAverage();

/// What numbers are measured on and with.
struct MachineFacts
{
  std::string processor;
  int cores = 0;   ///< visible ones
  int threads = 0; ///< used ones
  std::string compiler;
  std::string buildType;
  std::string date; ///< year-month-day
};

MachineFacts FactsOfMachine();

/// What the numbers were measured on and with, without any names of places: processor, threads,
/// compiler, build type, date, load before the start, and the command.
void WriteMachine(std::ostream& stream, const std::vector<std::string>& command, double loadBefore);
}

#endif
