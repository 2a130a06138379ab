// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_OverlayPlace_h
#define limpid_render_OverlayPlace_h

#include "math/Macros.h"
#include "math/Vec.h"

namespace limpid
{
/// Where the nodes of an overlay lie among those of scalars: over the same box, or over one of
/// which the scalars that are here are a part.
struct OverlayPlace
{
  Int3 nodes{ 0 };    ///< of the overlay
  Int3 boxNodes{ 0 }; ///< of scalars, in the box of the overlay
  Int3 first{ 0 };    ///< of these, where those that are here begin

  /// Over the box of the scalars that are here.
  static OverlayPlace Over(const Int3& scalarNodes, const Int3& nodes)
  {
    return { nodes, scalarNodes, Int3(0) };
  }

  /// Nodes of the overlay per node of the scalars.
  LIMPID_HD LIMPID_INLINE double Scale(int axis) const
  {
    const int cells = this->boxNodes[axis] > 1 ? this->boxNodes[axis] - 1 : 1;
    return double(this->nodes[axis] - 1) / cells;
  }
};
}

#endif
