// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The devices that the current compiler supports. Files with kernel launches are compiled twice:
// by the C++ compiler for the processor, by the CUDA compiler for CudaDevice.

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
/// The device on which this compiler tests the GPU code path; the C++ compiler simulates one.
#ifdef __CUDACC__
using CompiledDevice = CudaDevice;
#else
using CompiledDevice = SimulatedDevice;
#endif
}

/// Expands a macro for each device that this compiler supports.
#ifdef __CUDACC__
#define LIMPID_FOR_EACH_COMPILED_DEVICE(use) use(CudaDevice)
#else
#define LIMPID_FOR_EACH_COMPILED_DEVICE(use) use(HostDevice) use(SimulatedDevice)
#endif

#endif
