// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_NodeImportanceOfAll_h
#define limpid_NodeImportanceOfAll_h

#include "energy/NodeImportance.h"

#include <vector>

/// Node importance as if no node were empty.
inline std::vector<float> NodeImportanceOfAll(const limpid::Grid& grid, const float* importance)
{
  const std::vector<float> filled(static_cast<std::size_t>(grid.NodeCount()), 1.0f);
  return limpid::NodeImportanceOfFilled(grid, filled.data(), importance);
}

#endif
