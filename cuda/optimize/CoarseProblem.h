// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_CoarseProblem_h
#define limpid_optimize_CoarseProblem_h

#include "optimize/Problem.h"

#include <vector>

namespace limpid
{
/// A field of a problem's own slab, moved to the own slab of another grid over its box, see
/// Problem::OwnSlab and Resampled.
std::vector<float> MovedTo(
  const Problem& problem, const Grid& from, const float* field, const Grid& to);

/// A problem on a coarser grid over the same box, with fields of its own.
class CoarseProblem
{
public:
  /// With about 1/factor as many nodes along each axis. `given` must outlive it.
  CoarseProblem(const Problem& given, int factor);
  CoarseProblem(const CoarseProblem&) = delete;
  CoarseProblem& operator=(const CoarseProblem&) = delete;

  const Problem& Made() const { return this->Coarse; }

  /// What an extinction of this problem changes, added to the base extinction on a finer grid:
  /// detail of the base survives, and voxels that nothing asked to change keep their base bit by
  /// bit. `found`: in this problem's own slab, as the result is in that of the finer grid
  /// [1/length].
  std::vector<float> ChangedOn(const Grid& finer, const std::vector<float>& found) const;

private:
  std::vector<float> Restricted(const float* field, const Grid& to) const;
  void UseFields();
  void ShareFields();

  const Problem* Given;
  Problem Coarse;
  std::vector<float> Base;
  std::vector<float> Importance;
  std::vector<float> NodeImportance;
  std::vector<float> Previous; ///< empty: there is none
};
}

#endif
