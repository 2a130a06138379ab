// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Tests of what is written for devices are compiled twice: in Testing/Core for a device that is
// simulated on the processor, in Testing/Gpu for a GPU. There, all tests are skipped with the
// reason if there is none.

#ifndef limpid_test_TestedDevice_h
#define limpid_test_TestedDevice_h

#include "backend/Choice.h"

#ifdef __CUDACC__
#include "backend/CudaDevice.h"
#else
#include "SimulatedDevice.h"
#endif

#include <memory>

namespace limpid
{
#ifdef __CUDACC__
using TestedDevice = CudaDevice;
#else
using TestedDevice = SimulatedDevice;
#endif

inline std::shared_ptr<TestedDevice> MakeTestedDevice()
{
  return std::make_shared<TestedDevice>(FindCuda().device);
}
}

#endif
