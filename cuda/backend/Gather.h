// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_Gather_h
#define limpid_backend_Gather_h

namespace limpid
{
/**
 * out[i] = source[index[i]] + weight[i] (source[index[i] + 1] - source[index[i]]), i < count.
 *
 * The indices must ascend. Neighbouring targets then read neighbouring sources, and a vector unit
 * can permute registers instead of gathering from memory. `source` must be readable up to 32
 * values beyond the last index.
 */
void InterpolateGathered(
  const float* source, const int* index, const float* weight, int count, float* out);
}

#endif
