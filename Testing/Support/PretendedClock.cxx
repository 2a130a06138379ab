// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "PretendedClock.h"

#include "optimize/PassTime.h"

namespace limpid
{
namespace
{
/// The duration where no clock is pretended.
constexpr double someSecondsPerNode = 1e-7;
thread_local double pretended = someSecondsPerNode;
}

PretendedClock::PretendedClock(double secondsPerNode)
{
  pretended = secondsPerNode;
}

PretendedClock::~PretendedClock()
{
  pretended = someSecondsPerNode;
}

double SecondsPerNodeOf(Index, const std::function<void()>& pass)
{
  pass();
  return pretended;
}
}
