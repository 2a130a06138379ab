// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The order in which to draw two volumes, as far as there is one.

#ifndef limpid_DrawingOrder_h
#define limpid_DrawingOrder_h

#include "math/Vec.h"

#include <array>

class vtkRenderer;
class vtkVolume;

namespace limpid
{
/// A parallelepiped in world coordinates.
struct Box
{
  Vec3 corner{ 0.0 };
  std::array<Vec3, 3> edges{ { Vec3(0.0), Vec3(0.0), Vec3(0.0) } }; ///< from the corner
};

/// Returns the box of VTK's bounds, which are six numbers.
Box BoxOfBounds(const double* bounds);

/// Returns the box of a volume: that of its image, transformed as the volume is, or else that of
/// its bounds. Never throws.
Box BoxOf(vtkVolume* volume);

enum class Order
{
  Any,         ///< neither hides the other
  FirstFirst,  ///< the first is farther away: draw it first
  SecondFirst, ///< the second is farther away
  Overlapping  ///< no order is correct
};

/// Returns the order in which to draw two boxes for the renderer's camera. Boxes that touch do not
/// overlap.
Order OrderOf(const Box& first, const Box& second, vtkRenderer* renderer);
}

#endif
