// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The device that the present compiler writes for. Files that launch are compiled twice: by the C++
// compiler for HostDevice, by the CUDA compiler for CudaDevice.

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
#ifdef __CUDACC__
using CompiledDevice = CudaDevice;
#else
using CompiledDevice = HostDevice;
#endif
}

#endif
