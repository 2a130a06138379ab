// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_ScoreSweepOnDevice_h
#define limpid_viewpoint_ScoreSweepOnDevice_h

#include "backend/CompiledDevice.h"
#include "viewpoint/ScoreSweep.h"

namespace limpid
{
/// For parts of these fields, which stay with the caller; a copy of them is on the device.
template <class Device>
std::unique_ptr<ScoreSweep> ScoreSweepOn(std::shared_ptr<Device> device, const ViewFields& fields);
}

#endif
