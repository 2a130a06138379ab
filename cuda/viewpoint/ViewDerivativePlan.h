// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_ViewDerivativePlan_h
#define limpid_viewpoint_ViewDerivativePlan_h

#include "sweep/PlanOutline.h"

namespace limpid
{
/// Two moves of an eye, for all of its rays.
struct EyeMoves
{
  Vec3 moves[2];   ///< perpendicular to the direction to the focal point [length]
  double distance; ///< distance to the focal point [length]
};

/**
 * Where a sweep samples its fields to follow moves of the eye, and how the moves act on its rays
 * (ViewDerivativeKernel.h). Layers are divided into parts of equal thickness, front to back, with
 * a plane through each of the two Gauss points of a part. Rays are sampled at their centres. The
 * derivative across rays is that of the cubic through samples at four edges between rays.
 *
 * Unlike those of FaceFrustum, weights may be outside [0, 1]: beyond the border of the box, fields
 * are extrapolated linearly, so that lines through samples on both sides of the border are right
 * inside.
 */
struct ViewDerivativePlan : FlatTables
{
  int parts = 1;              ///< number of parts of a layer
  Table<float> fractions;     ///< [plane]: weight of the second slice of the layer [0, 1]
  Table<float> perIndex;      ///< [plane]: ray coordinate per index
  MapTable columns;           ///< [plane][column of Slice::rayColumns]: voxel column of a ray
  MapTable rows;              ///< [plane][row of Slice::rayRows]
  MapTable columnEdges;       ///< [plane][edge]: voxel column of an edge; two are before the first
                              ///< ray of Slice::rayColumns
  MapTable rowEdges;          ///< [plane][edge]: the same for rows
  Table<float> columnStencil; ///< [4][column]: weights of the edges column, ..., column + 3
  Table<float> rowStencil;    ///< [4][row]

  Table<float> columnSlope; ///< [column]: a, index step along the columns per unit of depth
  bool parallel = false;
  float front = 0;   ///< relative depth where rays start that do not enter through a side
  float depth = 0;   ///< point eye: depth of relative depth 0 [index]
  float inverse = 0; ///< parallel eye: 1 / distance to the centre of rotation [1/length]

  float moveAcross[2] = { 0, 0 }; ///< [move]: component of e along the columns [index]
  float moveDepth[2] = { 0, 0 };  ///< [move]: component of e along the depth axis [index]
  float moveFront[2] = { 0, 0 };  ///< [move]: P of a unit step through the front over length per
                                  ///< depth
  Table<float> moveDown;          ///< [move][row]: e' along the rows [index]
  Table<float> moveRow;   ///< [move][row]: P through sides that face v over length per depth
  Table<float> moveSide;  ///< [move][ray]: P of a unit step through the sides that face u
  Table<float> moveAlong; ///< [move][ray]: c

  /// Returns a map of a plane behind `slice` by the numbers of rays; `described`: its
  /// Slice::rayColumns or rayRows.
  LIMPID_HD LIMPID_INLINE LinearMap MapOf(
    const MapTable& table, Index plane, const Range<int>& described) const
  {
    return From(this->Row(table, static_cast<int>(plane)), described.begin);
  }

  /// Returns the index of plane `half` in part `part` of the layer behind slice `s`.
  LIMPID_HD LIMPID_INLINE Index PlaneOf(int s, int part, int half) const
  {
    return (Index(s) * this->parts + part) * 2 + half;
  }
};

/// Makes the plan for the rays of a frustum in a grid.
OwnedTables<ViewDerivativePlan> PlanViewDerivative(
  const PlannedFrustum& frustum, const Grid& grid, const EyeMoves& by, int parts);
}

#endif
