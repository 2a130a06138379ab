// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/Choice.h"

#include "backend/Backend.h"
#include "math/Require.h"

#include <cstdint>
#include <limits>
#include <sstream>

namespace limpid
{
namespace
{
/// Returns the reason why CUDA cannot be used; empty if it can.
std::string Obstacle(const GpuNeed& need)
{
  const CudaState& cuda = FindCuda();
  if (!cuda.usable)
  {
    return cuda.reason;
  }
  constexpr Index mostNodes = std::numeric_limits<std::int32_t>::max(); // kernels use 32-bit
                                                                        // indices
  std::ostringstream text;
  if (need.nodes > mostNodes)
  {
    text << "the scene has " << need.nodes << " points, and the GPU code supports at most "
         << mostNodes;
    return text.str();
  }
  const std::size_t free = FreeCudaBytes();
  if (need.bytes <= free)
  {
    return {};
  }
  text << "the scene needs about " << need.bytes / 1000000 << " MB, and only " << free / 1000000
       << " MB are free on the " << cuda.name;
  return text.str();
}
}

std::string CpuWithoutCuda(const std::string& reason)
{
  return CpuName() + " (no CUDA: " + reason + ")";
}

BackendChoice ChooseBackend(BackendKind wish, const GpuNeed& need)
{
  if (wish == BackendKind::Cpu)
  {
    return { false, CpuName() };
  }
  const std::string obstacle = Obstacle(need);
  LIMPID_REQUIRE(wish == BackendKind::Auto || obstacle.empty(),
    "CUDA was asked for, but " << obstacle
                               << " (the GPU cannot be used). Choose the backend Auto or CPU.");
  if (obstacle.empty())
  {
    return { true, "CUDA, " + FindCuda().name };
  }
  return { false, CpuWithoutCuda(obstacle) };
}
}
