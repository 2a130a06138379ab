// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// In place of CudaPartScorer.cxx where there is no CUDA compiler.

#include "math/Require.h"
#include "viewpoint/PartScorer.h"

namespace limpid
{
std::unique_ptr<PartScorer> CudaPartScorer(const ViewFields&)
{
  LIMPID_REQUIRE(false,
    "This build has no CUDA backend (nothing would run on a GPU). Choose the backend Auto or CPU.");
  return nullptr;
}
}
