// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// For the CUDA compiler.

#include "compute/BackendOn.h"

namespace limpid
{
const ComputeBackend& CudaBackend()
{
  static const BackendOn<CudaDevice> backend(CudaDevice::Shared());
  return backend;
}
}
