// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/PhysicalMemory.h"

#include <limits>

#if defined(__linux__)
#include <unistd.h>
#endif

namespace limpid
{
double PhysicalMemory()
{
#if defined(__linux__)
  const double bytes = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  if (bytes > 0)
  {
    return bytes;
  }
#endif
  return std::numeric_limits<double>::infinity();
}
}
