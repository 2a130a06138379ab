// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SimulatedDevice.h"

#include "math/Require.h"

#include <string>

namespace limpid
{
std::shared_ptr<SimulatedDevice> SimulatedDevice::Shared()
{
  static const auto shared = std::make_shared<SimulatedDevice>();
  return shared;
}

void SimulatedDevice::MayFail(const char* what)
{
  Index left = this->UntilFailure;
  while (left > 0 && !this->UntilFailure.compare_exchange_weak(left, left - 1))
  {
  }
  if (left == 0)
  {
    this->UntilFailure = Failed;
  }
  if (left == 0 || (left == Failed && this->FailsForGood))
  {
    throw DeviceError(std::string("The simulated GPU fails (") + what +
      "; a test requested this). Use the backend CPU.");
  }
}
}
