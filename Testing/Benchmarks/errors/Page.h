// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What was measured, for people.

#ifndef limpid_testing_benchmarks_errors_Page_h
#define limpid_testing_benchmarks_errors_Page_h

#include "Results.h"

#include <ostream>
#include <string>
#include <vector>

namespace limpid::benchmark
{
void WritePage(
  std::ostream& stream, const std::vector<SceneResult>& scenes, const std::string& cuda);
}

#endif
