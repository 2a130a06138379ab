// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Replaces FindCuda.cxx and CudaBackend.cxx in builds without CUDA.

#include "backend/Choice.h"
#include "backend/ComputeBackend.h"

namespace limpid
{
const CudaState& FindCuda()
{
  static const CudaState state{ false, 0, "", "this build has no CUDA backend" };
  return state;
}

std::size_t FreeCudaBytes()
{
  return 0;
}

const ComputeBackend& CudaBackend()
{
  ChooseBackend(BackendKind::Cuda, {}); // throws the reason
  return ProcessorBackend();
}
}
