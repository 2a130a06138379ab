// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Problem.h"

#include "backend/Backend.h"
#include "optimize/Differences.h"

#include <algorithm>
#include <numeric>

namespace limpid
{
double Problem::SquaresFromBase(const float* extinction) const
{
  // What is empty stays as it is in the base, see Solver's first iterate.
  const Int3& rows = this->grid.nodes;
  std::vector<double> slices(std::size_t(rows.z), 0.0);
  ParallelFor(rows.z,
    [&](Index z)
    {
      for (int y = 0; y < rows.y; ++y)
      {
        const Range<int> filled = this->occupancy->Row(0, y, int(z)).filled;
        const Index first = (z * rows.y + y) * rows.x + filled.begin;
        slices[std::size_t(z)] += SumOfSquares(
          extinction + first, this->baseExtinction + first, std::max(filled.Length(), 0));
      }
    });
  return std::accumulate(slices.begin(), slices.end(), 0.0);
}

double Problem::SmoothingStrength() const
{
  const Weights& weights = this->settings.weights;
  return this->majorant > 0
    ? this->settings.smoothness * (weights.view + weights.light) / double(this->majorant)
    : 0.0;
}

double Problem::Regularization(double squares) const
{
  return 0.5 * this->RegularizationWeight() * this->grid.CellVolume() * squares;
}

void Problem::CopyFilled(const float* from, float* to) const
{
  const Int3& nodes = this->grid.nodes;
  ParallelFor(Index(nodes.y) * nodes.z, 16,
    [&](Index row)
    {
      const auto y = static_cast<int>(row % nodes.y);
      const auto z = static_cast<int>(row / nodes.y);
      const Range<int> filled = this->occupancy->Row(0, y, z).filled;
      const Index first = row * nodes.x + filled.begin;
      std::copy_n(from + first, std::max(filled.Length(), 0), to + first);
    });
}

double Problem::MeanChange(double changes) const
{
  const auto filled = double(this->occupancy->FilledVoxels());
  return filled > 0 && this->majorant > 0 ? changes / filled / this->majorant : 0.0;
}
}
