// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_benchmarks_Program_h
#define limpid_testing_benchmarks_Program_h

#include "Options.h"

#include <functional>
#include <iosfwd>
#include <string>

namespace limpid::benchmark
{
/// What a program measures, written as Markdown below the description of the machine.
using Measurement = std::function<void(const Options& options, std::ostream& tables)>;

/// The main function of a benchmark: reads the options, measures, and writes one page. Returns the
/// program's status.
int RunProgram(int argc, char* argv[], const std::string& title, const Measurement& measure);
}

#endif
