// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_SliceWindow_h
#define limpid_sweep_SliceWindow_h

#include "backend/Simd.h"
#include "math/Range.h"
#include "math/Vec.h"

#include <memory>

namespace limpid
{
struct SlabMemory;

/// How a sweep uses a field, and on which slices besides the current one.
struct FieldUse
{
  int behind = 0; ///< number of slices behind that it reads, at most mostSlicesBehind
  bool writes = false;
  bool reads = true; ///< whether it reads values from before the sweep
  int inFront = 0;   ///< number of slices in front that it reads, at most mostSlicesInFront
};

/// Access to a field slice by slice along the depth axis of a frustum, with contiguous rows of
/// voxels. FieldSlabs opens windows and decides where the rows are.
struct SliceWindow
{
  float* field; ///< one value per node
  FieldUse use;
  int columns; ///< number of nodes along u
  int rows;    ///< number of nodes along v
  Index strideV;
  Index strideW;
  float* values;                        ///< address of node (0, 0, 0), which may not exist
  std::shared_ptr<SlabMemory> memory{}; ///< of copied slices

  /// Returns row `v` of the slice at a node: one value per column.
  float* Row(int node, int v) const
  {
    return this->values + this->strideW * node + this->strideV * v;
  }

  /// Prefetches row `v` of the slice at a node, or the last row.
  LIMPID_INLINE void Prefetch(int node, int v, const Range<int>& read) const
  {
    const float* row = this->Row(node, v < this->rows ? v : this->rows - 1);
    limpid::Prefetch(row + read.begin, row + read.end);
  }
};
}

#endif
