// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "scene/NodeValues.h"

#include "backend/LargePages.h"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace limpid
{
NodeValues::NodeValues(Index count)
{
  // For large fields, the system supplies pages of zeros that need not be written.
  const auto values = static_cast<std::size_t>(std::max<Index>(count, 1));
  this->Memory.reset(static_cast<float*>(AllocateZeroPages(values * sizeof(float))));
  if (!this->Memory)
  {
    throw std::bad_alloc();
  }
}

void NodeValues::Free::operator()(float* memory) const noexcept
{
  std::free(memory);
}
}
