// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// In place of CudaPictures.cxx where there is no CUDA compiler.

#include "backend/Choice.h"
#include "render/PictureEngine.h"

namespace limpid
{
std::unique_ptr<PictureEngine> CudaPictures()
{
  ChooseBackend(BackendKind::Cuda, 0); // says why not
  return nullptr;
}
}
