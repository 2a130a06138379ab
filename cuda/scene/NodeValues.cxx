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
  // Of large fields calloc() gives pages of zeros that it does not have to write.
  const auto values = static_cast<std::size_t>(std::max<Index>(count, 1));
  this->Memory.reset(static_cast<float*>(std::calloc(values, sizeof(float))));
  if (!this->Memory)
  {
    throw std::bad_alloc();
  }
  UseLargePages(this->Memory.get(), values * sizeof(float));
}

void NodeValues::Free::operator()(float* memory) const noexcept
{
  std::free(memory);
}
}
