// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Linked into a program ahead of the core, this stands in for FindCuda.cxx and all that computes on
// a GPU: the processor in the role of one. What such a program tests is written for a GPU, as a
// whole and from the solver down.

#include "backend/Choice.h"
#include "backend/HostDevice.h"
#include "optimize/EngineOnDevice.h"
#include "render/RenderPasses.h"
#include "viewpoint/ScoreSweepOnDevice.h"

#include <memory>

namespace limpid
{
namespace
{
std::shared_ptr<HostDevice> Shared()
{
  static const auto device = std::make_shared<HostDevice>();
  return device;
}
}

const CudaState& FindCuda()
{
  static const CudaState state{ true, 0, "processor", "" };
  return state;
}

std::size_t FreeCudaBytes()
{
  return std::size_t(1) << 36;
}

std::shared_ptr<Engine> CudaEngine()
{
  return EngineOn(Shared());
}

std::unique_ptr<RenderBackend> CudaRenderBackend()
{
  return std::make_unique<RenderPasses<SimulatedDevice>>(std::make_shared<SimulatedDevice>());
}

std::unique_ptr<ScoreSweep> CudaScoreSweep(const ViewFields& fields)
{
  return ScoreSweepOn(Shared(), fields);
}
}
