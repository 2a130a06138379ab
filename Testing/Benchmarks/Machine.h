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

/// What the numbers were measured on and with, without any names of places: processor, threads,
/// compiler, build type, date, load before the start, and the command.
void WriteMachine(std::ostream& stream, const std::vector<std::string>& command, double loadBefore);
}

#endif
