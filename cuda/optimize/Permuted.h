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
class HostDevice;

/// The fields of a scene with permuted axes.
struct PermutedFields
{
  AxisPermutation order;
  NodeValues base;           ///< [1/length]
  NodeValues importance;     ///< [0, 1]
  NodeValues nodeImportance; ///< [0, 1]
  std::shared_ptr<const Occupancy> occupancy;
};

/**
 * Returns the permutation of axes for which sweeps read memory in order. The camera, which is
 * swept most, gets the last axis as depth, so that slices are contiguous. Rows run along an axis
 * that is neither the camera's nor the light's depth axis, so that no slice has to be transposed.
 */
AxisPermutation OrderFor(const Problem& problem);

/// Returns the permutation of axes for which a device sweeps fastest. GPUs sweep any order.
template <class AnyDevice>
AxisPermutation FastestOrder(const AnyDevice&, const Problem&)
{
  return {};
}

inline AxisPermutation FastestOrder(const HostDevice&, const Problem& problem)
{
  return OrderFor(problem);
}

/// Permutes the grid and the ray sources of a problem. The caller has to permute the fields. Data
/// cached for the original order (Problem::resident) is dropped.
Problem Reordered(const Problem& problem, const AxisPermutation& order);

/// Returns a minimiser that works on the permuted problem and returns results in the original
/// order. `make`: makes a minimiser of the permuted problem, which outlives it.
std::unique_ptr<Minimizer> MakePermuted(const Problem& problem, const AxisPermutation& order,
  StartingExtinction&& start,
  const std::function<std::unique_ptr<Minimizer>(const Problem&, StartingExtinction&&)>& make);
}

#endif
