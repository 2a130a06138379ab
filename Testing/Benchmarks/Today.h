// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_benchmarks_Today_h
#define limpid_testing_benchmarks_Today_h

#include <ctime>
#include <string>

namespace limpid
{
/// Returns the local date: "2026-11-28".
inline std::string Today()
{
  const std::time_t now = std::time(nullptr);
  char date[16] = "";
  std::strftime(date, sizeof(date), "%Y-%m-%d", std::localtime(&now));
  return date;
}
}

#endif
