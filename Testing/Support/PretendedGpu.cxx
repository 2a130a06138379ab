// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Linked into a program ahead of the core, this stands in for FindCuda.cxx and CudaBackend.cxx: the
// processor in the role of a GPU. What such a program tests is written for a GPU, as a whole and
// from the solver down.

#include "SimulatedDevice.h"

#include "backend/Choice.h"
#include "compute/BackendOn.h"

#include <memory>

namespace limpid
{
const CudaState& FindCuda()
{
  static const CudaState state{ true, 0, "processor", "" };
  return state;
}

std::size_t FreeCudaBytes()
{
  return std::size_t(1) << 36;
}

const ComputeBackend& CudaBackend()
{
  static const BackendOn<SimulatedDevice> backend(SimulatedDevice::Shared());
  return backend;
}
}
