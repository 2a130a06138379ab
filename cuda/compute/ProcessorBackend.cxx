// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "compute/BackendOn.h"

namespace limpid
{
const ComputeBackend& ProcessorBackend()
{
  static const BackendOn<HostDevice> backend(HostDevice::Shared());
  return backend;
}
}
