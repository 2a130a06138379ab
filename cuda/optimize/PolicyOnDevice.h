// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_PolicyOnDevice_h
#define limpid_optimize_PolicyOnDevice_h

#include "optimize/FieldsOnDevice.h"
#include "optimize/PolicySweep.h"

#include <memory>
#include <vector>

namespace limpid
{
/// SweepPolicy on a device through all frusta of a term. The fields of `task` are addresses
/// there; those of the scene are taken from `scene`.
template <class Device>
void SweepPolicyOnDevice(Device& device, TermOnDevice<Device>& term,
  const FieldsOnDevice<Device>& scene, const PolicyTask& task);

/// MakePolicy on a device. `start`: empty, the base extinction, which is there already.
template <class Device>
std::unique_ptr<Minimizer> MakePolicyOnDevice(const std::shared_ptr<Device>& device,
  const Problem& problem, const std::vector<float>& start, bool warm);
}

#endif
