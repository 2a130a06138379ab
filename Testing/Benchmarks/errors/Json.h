// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What was measured, for the plots.

#ifndef limpid_testing_benchmarks_errors_Json_h
#define limpid_testing_benchmarks_errors_Json_h

#include "Results.h"

#include <ostream>
#include <vector>

namespace limpid::benchmark
{
void WriteJson(std::ostream& stream, const std::vector<SceneResult>& scenes, double loadBefore,
  const std::string& cuda);
}

#endif
