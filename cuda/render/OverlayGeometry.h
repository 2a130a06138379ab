// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_OverlayGeometry_h
#define limpid_render_OverlayGeometry_h

#include "math/Macros.h"
#include "math/Vec.h"

namespace limpid
{
/// The position of an overlay's nodes relative to the scalars: over the same box, or over one of
/// which the scalars are a part.
struct OverlayGeometry
{
  Int3 nodes{ 0 };    ///< nodes of the overlay
  Int3 boxNodes{ 0 }; ///< number of scalars in the box of the overlay
  Int3 first{ 0 };    ///< index of the first scalar among these

  /// Returns the place of an overlay over the box of the scalars.
  static OverlayGeometry Over(const Int3& scalarNodes, const Int3& nodes)
  {
    return { nodes, scalarNodes, Int3(0) };
  }

  /// Returns the number of nodes of the overlay per node of the scalars.
  LIMPID_HD LIMPID_INLINE double Scale(int axis) const
  {
    const int cells = this->boxNodes[axis] > 1 ? this->boxNodes[axis] - 1 : 1;
    return double(this->nodes[axis] - 1) / cells;
  }
};
}

#endif
