// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_ProblemInFront_h
#define limpid_optimize_ProblemInFront_h

#include "optimize/Problem.h"
#include "scene/OpaqueGeometry.h"

#include <vector>

namespace limpid
{
/// A problem for the scores of a camera whose rays end at opaque geometry, if there is any.
class ProblemInFront
{
public:
  /// `grid`: of the nodes in the problem's arrays. `opaque`: null: the problem as it is.
  ProblemInFront(const Problem& problem, const Grid& grid, const OpaqueGeometry* opaque)
    : Seen(problem)
  {
    if (opaque)
    {
      this->Importance = opaque->InFront(grid, problem.importance);
      this->Seen.importance = this->Importance.data();
      this->Seen.resident = nullptr; // what is kept there has all of the importance
    }
  }

  ProblemInFront(const ProblemInFront&) = delete;
  ProblemInFront& operator=(const ProblemInFront&) = delete;

  const Problem& Get() const { return this->Seen; }

private:
  std::vector<float> Importance; ///< in front of the geometry
  Problem Seen;
};
}

#endif
