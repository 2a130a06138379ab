// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/Choice.h"

#include "backend/Backend.h"
#include "math/Require.h"

#include <sstream>

namespace limpid
{
namespace
{
/// Why CUDA cannot be used for so many bytes; empty: it can.
std::string Obstacle(std::size_t bytes)
{
  const CudaState& cuda = FindCuda();
  if (!cuda.usable)
  {
    return cuda.reason;
  }
  const std::size_t free = FreeCudaBytes();
  if (bytes <= free)
  {
    return {};
  }
  std::ostringstream text;
  text << "the scene needs about " << bytes / 1000000 << " MB, " << free / 1000000
       << " MB are free on the " << cuda.name;
  return text.str();
}
}

std::string CpuWithoutCuda(const std::string& reason)
{
  return CpuName() + " (no CUDA: " + reason + ")";
}

BackendChoice ChooseBackend(BackendKind wish, std::size_t bytes)
{
  if (wish == BackendKind::Cpu)
  {
    return { false, CpuName() };
  }
  const std::string obstacle = Obstacle(bytes);
  LIMPID_REQUIRE(wish == BackendKind::Auto || obstacle.empty(),
    "CUDA was asked for, but " << obstacle
                               << " (nothing would run on a GPU). Choose the backend Auto or CPU.");
  if (obstacle.empty())
  {
    return { true, "CUDA, " + FindCuda().name };
  }
  return { false, CpuWithoutCuda(obstacle) };
}
}
