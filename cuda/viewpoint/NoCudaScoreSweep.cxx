// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// In place of CudaScoreSweep.cxx where there is no CUDA compiler.

#include "backend/Choice.h"
#include "viewpoint/ScoreSweep.h"

namespace limpid
{
std::unique_ptr<ScoreSweep> CudaScoreSweep(const ViewFields&)
{
  ChooseBackend(BackendKind::Cuda, 0); // says why not
  return nullptr;
}
}
