// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// In place of CudaPictures.cxx where there is no CUDA compiler.

#include "math/Require.h"
#include "render/PictureEngine.h"

namespace limpid
{
std::unique_ptr<PictureEngine> CudaPictures()
{
  LIMPID_REQUIRE(false,
    "This build has no CUDA backend (nothing would run on a GPU). Choose the backend Auto or CPU.");
  return nullptr;
}
}
