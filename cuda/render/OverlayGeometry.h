// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_OverlayGeometry_h
#define limpid_render_OverlayGeometry_h

#include "math/Vec.h"
#include "render/DrawnPart.h"

#include <algorithm>

namespace limpid
{
/// The position of an overlay's nodes relative to the scalars.
struct OverlayGeometry
{
  Int3 nodes{ 0 }; ///< nodes of the overlay
  Int3 first{ 0 }; ///< the first scalar, counted from the first node of the overlay [scalars]
  Vec3 scale{ 1 }; ///< nodes of the overlay per node of the scalars

  bool operator==(const OverlayGeometry& other) const
  {
    return this->nodes == other.nodes && this->first == other.first && this->scale == other.scale;
  }

  /// `overlay`: has the nodes of the scalars, or all nodes of another grid over the whole.
  static OverlayGeometry Of(const DrawnPart& overlay, const DrawnPart& scalars)
  {
    OverlayGeometry place;
    place.nodes = overlay.Nodes().nodes;
    place.first = scalars.Box().First() - overlay.Box().First();
    for (int axis = 0; axis < 3; ++axis)
    {
      const int cells = std::max(scalars.Whole().nodes[axis] - 1, 1);
      place.scale[axis] = double(overlay.Whole().nodes[axis] - 1) / cells;
    }
    return place;
  }
};
}

#endif
