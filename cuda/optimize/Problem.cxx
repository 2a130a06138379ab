// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Problem.h"

#include "backend/Backend.h"
#include "optimize/Sums.h"

#include <numeric>

namespace limpid
{
namespace
{
/// Sum over all rows of voxels that may change of body(first voxel, count), in a fixed order. What
/// is empty stays as it is in the base, see Solver's first iterate.
template <class Body>
double SumOverFilled(const Problem& problem, const Body& body)
{
  const Int3& nodes = problem.grid.nodes;
  std::vector<double> slices(std::size_t(nodes.z), 0.0);
  ParallelFor(nodes.z,
    [&](Index z)
    {
      for (int y = 0; y < nodes.y; ++y)
      {
        const Interval filled = problem.occupancy->Row(0, y, int(z)).filled;
        if (!filled.Empty())
        {
          slices[std::size_t(z)] +=
            body((z * nodes.y + y) * nodes.x + filled.begin, filled.end - filled.begin);
        }
      }
    });
  return std::accumulate(slices.begin(), slices.end(), 0.0);
}
}

double Problem::Regularization(const std::vector<float>& extinction) const
{
  const double sum = SumOverFilled(*this,
    [&](Index first, Index count)
    { return SumOfSquares(extinction.data() + first, this->baseExtinction + first, count); });
  return 0.5 * this->RegularizationWeight() * this->grid.CellVolume() * sum;
}

double Problem::MeanChange(
  const std::vector<float>& from, const std::vector<float>& to, Index filledVoxels) const
{
  if (filledVoxels == 0 || !(this->majorant > 0))
  {
    return 0;
  }
  const double sum = SumOverFilled(*this,
    [&](Index first, Index count)
    { return SumOfChanges(from.data() + first, to.data() + first, count); });
  return sum / double(filledVoxels) / this->majorant;
}
}
