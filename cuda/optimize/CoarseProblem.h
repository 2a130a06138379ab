// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_CoarseProblem_h
#define limpid_optimize_CoarseProblem_h

#include "optimize/Problem.h"

#include <vector>

namespace limpid
{
/// Resamples a field from the own slab of one grid to the own slab of another grid over the same
/// box, see Problem::OwnSlab and Resampled.
std::vector<float> MovedTo(
  const Problem& problem, const Grid& from, const float* field, const Grid& to);

/// A problem on a coarser grid over the same box, with its own fields.
class CoarseProblem
{
public:
  /// Builds a grid with about 1/factor as many nodes along each axis. `given` must outlive it.
  CoarseProblem(const Problem& given, int factor);
  CoarseProblem(const CoarseProblem&) = delete;
  CoarseProblem& operator=(const CoarseProblem&) = delete;

  const Problem& Made() const { return this->Coarse; }

  /// Adds the change that `found` makes to the coarse base extinction to the base extinction of a
  /// finer grid. Detail of the base is preserved, and voxels without change keep their base bit by
  /// bit. `found` is on this problem's own slab, the result on that of the finer grid [1/length].
  std::vector<float> ChangedOn(const Grid& finer, const std::vector<float>& found) const;

private:
  std::vector<float> Restricted(const float* field, const Grid& to) const;
  void UseFields();

  const Problem* Given;
  Problem Coarse;
  std::vector<float> Base;
  std::vector<float> Importance;
  NodeValues NodeImportance;
  std::vector<std::vector<float>> References; ///< one per further pull
};
}

#endif
