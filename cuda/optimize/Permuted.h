// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Permuted_h
#define limpid_optimize_Permuted_h

#include "optimize/Problem.h"
#include "scene/AxisPermutation.h"
#include "scene/NodeValues.h"

#include <functional>

namespace limpid
{
/// The fields of a scene in another order of memory.
struct PermutedFields
{
  AxisPermutation order;
  NodeValues base;           ///< [1/length]
  NodeValues importance;     ///< [0, 1]
  NodeValues nodeImportance; ///< [0, 1]
  std::shared_ptr<const Occupancy> occupancy;
};

/**
 * The order in which sweeps find what they need next to each other: the camera, which is swept
 * most, looks along the last axis, so that slices are contiguous, and rows run along an axis that
 * neither it nor the light looks along, so that no slice has to be transposed.
 */
AxisPermutation OrderFor(const Problem& problem);

/// A problem whose nodes and sources of rays are in another order of axes. The fields, which are
/// the caller's business, are still in the old one; what engines keep of these is left out.
Problem Reordered(const Problem& problem, const AxisPermutation& order);

/// A minimiser that works in that order, and gives its results in that of the problem. `make`:
/// makes one that works in the order of its problem, which stays alive.
std::unique_ptr<Minimizer> MakePermuted(const Problem& problem, StartingExtinction&& start,
  const std::function<std::unique_ptr<Minimizer>(const Problem&, StartingExtinction&&)>& make);
}

#endif
