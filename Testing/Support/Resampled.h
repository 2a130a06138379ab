// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_Resampled_h
#define limpid_testing_Resampled_h

#include "scene/Resampling.h"

#include <vector>

namespace limpid
{
/// Resamples a whole field to another grid over the same box.
inline std::vector<float> Resampled(const Grid& from, const float* field, const Grid& to)
{
  return ResampledBox(GridFilter(from.nodes, to.nodes), field, NodeBox::Of(to.nodes));
}
}

#endif
