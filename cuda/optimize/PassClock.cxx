// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/PassTime.h"

#include <algorithm>
#include <chrono>

namespace limpid
{
// Alone in a file: a program that links another definition ahead of the core has another clock.
double SecondsPerNodeOf(Index nodes, const std::function<void()>& pass)
{
  const auto start = std::chrono::steady_clock::now();
  pass();
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  return taken.count() / double(std::max<Index>(nodes, 1));
}
}
