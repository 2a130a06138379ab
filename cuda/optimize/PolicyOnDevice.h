// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_PolicyOnDevice_h
#define limpid_optimize_PolicyOnDevice_h

#include "backend/CompiledDevice.h"
#include "optimize/Problem.h"

#include <memory>
#include <vector>

namespace limpid
{
/// MakePolicy on a device.
template <class Device>
std::unique_ptr<Minimizer> MakePolicyOnDevice(const std::shared_ptr<Device>& device,
  const Problem& problem, const std::vector<float>& start, bool warm);
}

#endif
