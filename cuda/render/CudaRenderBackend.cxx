// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// For the CUDA compiler. Where there is none, the C++ compiler makes of this what nobody calls.

#include "render/RenderPasses.h"

namespace limpid
{
std::unique_ptr<RenderBackend> CudaRenderBackend()
{
  return std::make_unique<RenderPasses<CompiledDevice>>(CompiledDevice::Shared());
}
}
