// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_RayWindows_h
#define limpid_sweep_RayWindows_h

#include "sweep/PlanOutline.h"

#include <vector>

namespace limpid
{
/// Whether an image is much longer than it is wide and high. Rays of such images are chosen so that
/// the work grows with the number of nodes.
bool IsLong(const Int3& nodes);

/**
 * The rays that a plan describes on each slice.
 *
 * A ray can only matter to a slice if it meets the box in a layer next to it. In a long box that is
 * seen from an angle, this holds for few rays on each slice, and most pairs of a column and a row
 * never meet the box. Plans and sweeps then leave out what lies far beside the box, so that their
 * cost grows with the number of nodes and not with a power of the length.
 */
struct RayWindows
{
  int mostColumns = 0; ///< largest number of columns on a slice
  int mostRows = 0;
  std::vector<Range<int>> rowColumns; ///< [row]: columns of rays that have values
  std::vector<Range<int>> rowLayers;  ///< [row]: see FaceFrustum
  double rays = 0;                    ///< number of rays that have values
  bool banded = false;                ///< see FaceFrustum

  /// Finds the windows, and sets the ranges of rays of all slices. `nodes`: those of the grid.
  RayWindows(const PlannedFrustum& frustum, const Int3& nodes, const PlanSettings& settings,
    std::vector<Slice>& slices);
};
}

#endif
