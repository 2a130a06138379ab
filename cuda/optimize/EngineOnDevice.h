// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_EngineOnDevice_h
#define limpid_optimize_EngineOnDevice_h

#include "backend/CompiledDevice.h"
#include "optimize/Engine.h"

namespace limpid
{
/// Whatever is wanted, on a device.
template <class Device>
std::shared_ptr<Engine> EngineOn(std::shared_ptr<Device> device);
}

#endif
