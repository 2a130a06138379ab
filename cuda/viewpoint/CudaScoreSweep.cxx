// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// For the CUDA compiler.

#include "viewpoint/ScoreSweepOnDevice.h"

namespace limpid
{
std::unique_ptr<ScoreSweep> CudaScoreSweep(const ViewFields& fields)
{
  return ScoreSweepOn(CudaDevice::Shared(), fields);
}
}
