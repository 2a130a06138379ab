// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// For the CUDA compiler.

#include "render/RendererOnDevice.h"

namespace limpid
{
std::unique_ptr<PictureEngine> CudaPictures()
{
  return PicturesOn(CudaDevice::Shared());
}
}
