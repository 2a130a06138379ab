// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Problem.h"

#include "backend/Backend.h"
#include "optimize/Sums.h"

namespace limpid
{
double Problem::Regularization(const std::vector<float>& extinction) const
{
  const double sum = ParallelBlockSum(this->grid.NodeCount(),
    [&](Index begin, Index end)
    { return SumOfSquares(extinction.data() + begin, this->baseExtinction + begin, end - begin); });
  return 0.5 * this->RegularizationWeight() * this->grid.CellVolume() * sum;
}

double Problem::MeanChange(
  const std::vector<float>& from, const std::vector<float>& to, Index filledVoxels) const
{
  if (filledVoxels == 0 || !(this->majorant > 0))
  {
    return 0;
  }
  const double sum = ParallelBlockSum(this->grid.NodeCount(),
    [&](Index begin, Index end)
    { return SumOfChanges(from.data() + begin, to.data() + begin, end - begin); });
  return sum / double(filledVoxels) / this->majorant;
}
}
