// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What was measured, for people.

#ifndef limpid_testing_gpu_Page_h
#define limpid_testing_gpu_Page_h

#include "Results.h"

#include <ostream>

namespace limpid::benchmark
{
/// Everything but the heading and the machine, as Markdown.
void WritePage(std::ostream& stream, const DeviceResult& result);
}

#endif
