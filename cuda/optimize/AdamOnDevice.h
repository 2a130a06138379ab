// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_AdamOnDevice_h
#define limpid_optimize_AdamOnDevice_h

#include "backend/CompiledDevice.h"
#include "optimize/AdamLevel.h"

#include <memory>
#include <vector>

namespace limpid
{
/// MakeAdamLevel on a device.
template <class Device>
std::unique_ptr<AdamLevel> MakeAdamLevelOnDevice(
  const std::shared_ptr<Device>& device, const Problem& problem, const std::vector<float>& start);
}

#endif
