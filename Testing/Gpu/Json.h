// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What was measured, for programs: seconds and bytes.

#ifndef limpid_testing_gpu_Json_h
#define limpid_testing_gpu_Json_h

#include "Results.h"

#include <ostream>

namespace limpid::benchmark
{
void WriteJson(std::ostream& stream, const DeviceResult& result);
}

#endif
