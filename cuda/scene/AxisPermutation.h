// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_AxisPermutation_h
#define limpid_scene_AxisPermutation_h

#include "scene/Grid.h"
#include "scene/RaySource.h"

namespace limpid
{
/// An order of a grid's axes in memory: the first, second and third axis are these axes of the
/// grid.
struct AxisPermutation
{
  Int3 axes{ 0, 1, 2 };

  bool Changes() const { return this->axes != Int3(0, 1, 2); }

  /// Returns a grid with these nodes at the same places, its axes in this order.
  Grid Of(const Grid& grid) const;

  /// Returns these rays in the index space of that grid.
  RaySource Of(const RaySource& source) const;
};

/// Copies a whole field on a grid to the permuted order.
void Permute(const Grid& grid, const AxisPermutation& order, const float* field, float* permuted);

/// Copies a whole field back from the permuted order.
void PermuteBack(
  const Grid& grid, const AxisPermutation& order, const float* permuted, float* field);
}

#endif
