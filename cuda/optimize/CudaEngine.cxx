// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// For the CUDA compiler.

#include "optimize/EngineOnDevice.h"

namespace limpid
{
std::shared_ptr<Engine> CudaEngine()
{
  return EngineOn(CudaDevice::Shared());
}
}
