// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_IndexBox_h
#define limpid_scene_IndexBox_h

#include "math/Macros.h"
#include "math/Vec.h"

namespace limpid
{
/// A box of nodes of a grid, or of blocks of them, for kernels.
struct IndexBox
{
  Int3 first;
  Int3 last; ///< included

  /// Returns whether is(index) holds for any index of the box in a grid of `counts`, first axis
  /// fastest.
  template <class Is>
  LIMPID_HD LIMPID_INLINE bool Any(const Int3& counts, const Is& is) const
  {
    for (int k = this->first.z; k <= this->last.z; ++k)
    {
      for (int j = this->first.y; j <= this->last.y; ++j)
      {
        const Index row = counts.x * (j + Index(counts.y) * k);
        for (int i = this->first.x; i <= this->last.x; ++i)
        {
          if (is(row + i))
          {
            return true;
          }
        }
      }
    }
    return false;
  }
};
}

#endif
