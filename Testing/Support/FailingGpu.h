// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The pretended GPU (PretendedGpu.cxx), made to fail.

#ifndef limpid_FailingGpu_h
#define limpid_FailingGpu_h

#include "SimulatedDevice.h"

namespace limpid
{
/// The one that a program with PretendedGpu.cxx has.
inline SimulatedDevice& Gpu()
{
  return *SimulatedDevice::Shared();
}

/// Fails at one of the next operations, once or from there on; forgets to do so in the end.
class FailingGpu
{
public:
  FailingGpu(Index operation, bool forGood) { Gpu().FailAt(operation, forGood); }
  ~FailingGpu() { Gpu().FailAt(-1, false); }
  FailingGpu(const FailingGpu&) = delete;
  FailingGpu& operator=(const FailingGpu&) = delete;
};
}

#endif
