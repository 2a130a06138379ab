// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// For the CUDA compiler.

#include "viewpoint/PartScorerOnDevice.h"

namespace limpid
{
std::unique_ptr<PartScorer> CudaPartScorer(const ViewFields& fields)
{
  return PartScorerOn(CudaDevice::Shared(), fields);
}
}
