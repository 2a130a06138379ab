// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/RenderBackend.h"

#include "backend/Choice.h"
#include "render/RenderPasses.h"

namespace limpid
{
std::unique_ptr<RenderBackend> MakeRenderBackend(bool cuda)
{
  if (cuda)
  {
    ChooseBackend(BackendKind::Cuda, 0); // says why not, if it cannot be had
    return CudaRenderBackend();
  }
  return std::make_unique<RenderPasses<HostDevice>>(HostDevice::Shared());
}
}
