// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// In place of CudaEngine.cxx where there is no CUDA compiler.

#include "backend/Choice.h"
#include "optimize/Engine.h"

namespace limpid
{
std::shared_ptr<Engine> CudaEngine()
{
  ChooseBackend(BackendKind::Cuda, 0); // says why not
  return nullptr;
}
}
