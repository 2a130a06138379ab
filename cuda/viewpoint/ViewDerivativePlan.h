// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_ViewDerivativePlan_h
#define limpid_viewpoint_ViewDerivativePlan_h

#include "sweep/PlanSweep.h"

namespace limpid
{
/// Two moves of an eye, by one of its rays or all of them.
struct EyeMoves
{
  Vec3 moves[2];   ///< across the way to the focal point [length]
  double distance; ///< to the focal point [length]
};

/**
 * Where a sweep that follows moves of the eye samples its fields, and what the moves are to its
 * rays (ViewDerivativeKernel.h). Layers are cut into parts of the same thickness, front to back; a
 * plane goes through each of the two Gauss points of a part. Rays meet it in their middles; the
 * derivative across them is that of the cubic through samples at four edges between rays.
 *
 * Unlike those of FaceFrustum, weights go beyond [0, 1] outside the box: what is sampled there goes
 * on as it does at the border, so that lines through samples on both sides of it are right inside.
 */
struct ViewDerivativePlan : FlatTables
{
  int parts = 1;              ///< of a layer
  Table<float> fractions;     ///< [plane]: weight of the second slice of the layer [0, 1]
  Table<float> perIndex;      ///< [plane]: units of the rays' coordinates per index
  MapTable columns;           ///< [plane][column]: voxel column of a ray
  MapTable rows;              ///< [plane][row]
  MapTable columnEdges;       ///< [plane][column]: ... of two edges before the first ray and so on
  MapTable rowEdges;          ///< [plane][row]
  Table<float> columnStencil; ///< [4][column]: of the values at the edges column, ..., column + 3
  Table<float> rowStencil;    ///< [4][row]

  Table<float> columnSlope; ///< [column]: a, index step along the columns per unit of depth
  bool parallel = false;
  float front = 0;   ///< relative depth where rays begin that do not enter through a side
  float depth = 0;   ///< point eye: depth of relative depth 0 [index]
  float inverse = 0; ///< parallel eye: 1 / distance to the point about which it turns [1/length]

  float moveAcross[2] = { 0, 0 }; ///< e along the columns, of either move [index]
  float moveDepth[2] = { 0, 0 };  ///< ... along the depth axis [index]
  float moveFront[2] = { 0, 0 };  ///< P of a step of 1 through the front, over the length per depth
  Table<float> moveDown;          ///< [move][row]: e' along the rows [index]
  Table<float> moveRow;   ///< [move][row]: P through sides that face v, over the length per depth
  Table<float> moveSide;  ///< [move][ray]: P of a step of 1 through the sides that face u
  Table<float> moveAlong; ///< [move][ray]: c

  /// The number of plane `half` in part `part` of the layer behind slice `s`.
  LIMPID_HD LIMPID_INLINE Index PlaneOf(int s, int part, int half) const
  {
    return (Index(s) * this->parts + part) * 2 + half;
  }
};

/// For the rays of a frustum in a grid.
OwnedTables<ViewDerivativePlan> PlanViewDerivative(
  const PlannedFrustum& frustum, const Grid& grid, const EyeMoves& by, int parts);
}

#endif
