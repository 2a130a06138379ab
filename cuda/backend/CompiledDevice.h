// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The devices that the present compiler writes for. Files that launch are compiled twice: by the
// C++ compiler for the processor, by the CUDA compiler for CudaDevice.

#ifndef limpid_backend_CompiledDevice_h
#define limpid_backend_CompiledDevice_h

#include "backend/DeviceArray.h"

#ifdef __CUDACC__
#include "backend/CudaDevice.h"
#else
#include "backend/HostDevice.h"
#endif

namespace limpid
{
/// The device for which this compiler's code is tested as that of a GPU.
#ifdef __CUDACC__
using CompiledDevice = CudaDevice;
#else
using CompiledDevice = SimulatedDevice;
#endif
}

/// Calls a macro with each of the devices that this compiler writes for.
#ifdef __CUDACC__
#define LIMPID_FOR_EACH_COMPILED_DEVICE(use) use(CudaDevice)
#else
#define LIMPID_FOR_EACH_COMPILED_DEVICE(use) use(HostDevice) use(SimulatedDevice)
#endif

#endif
