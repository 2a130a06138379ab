// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Tests of what is written for devices are compiled twice like what they test: in Testing/Core for
// the processor in the role of a device, in Testing/Gpu for a GPU. There, all tests are skipped
// with the reason if there is none.

#ifndef limpid_test_TestedDevice_h
#define limpid_test_TestedDevice_h

#include "backend/Choice.h"
#include "backend/CompiledDevice.h"

#include <memory>

namespace limpid
{
using TestedDevice = CompiledDevice;

inline std::shared_ptr<TestedDevice> MakeTestedDevice()
{
  return std::make_shared<TestedDevice>(FindCuda().device);
}
}

#endif
