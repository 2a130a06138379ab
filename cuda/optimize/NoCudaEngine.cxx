// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// In place of CudaEngine.cxx where there is no CUDA compiler.

#include "math/Require.h"
#include "optimize/Engine.h"

namespace limpid
{
std::shared_ptr<Engine> CudaEngine()
{
  LIMPID_REQUIRE(false,
    "This build has no CUDA backend (nothing would run on a GPU). Choose the backend Auto or CPU.");
  return nullptr;
}
}
