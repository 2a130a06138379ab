// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The device for which a source is compiled. Files with kernel launches are compiled once for each
// device: by the C++ compiler for the processor, by the CUDA compiler for CudaDevice. Tests compile
// them for a device of their own, whose header is LIMPID_DEVICE_HEADER.

#ifndef limpid_backend_CompiledDevice_h
#define limpid_backend_CompiledDevice_h

#include "backend/DeviceArray.h"

#if defined(LIMPID_DEVICE_HEADER)
#include LIMPID_DEVICE_HEADER
#elif defined(__CUDACC__)
#include "backend/CudaDevice.h"
namespace limpid
{
using CompiledDevice = CudaDevice;
}
#else
#include "backend/HostDevice.h"
namespace limpid
{
using CompiledDevice = HostDevice;
}
#endif

#endif
