// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Problem.h"

#include "backend/Backend.h"
#include "optimize/Differences.h"
#include "optimize/ExtinctionBounds.h"

#include <algorithm>
#include <numeric>

namespace limpid
{
double Problem::SquaresFrom(const float* other, const float* extinction) const
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
        slices[std::size_t(z)] +=
          SumOfSquares(extinction + first, other + first, std::max(filled.Length(), 0));
      }
    });
  return std::accumulate(slices.begin(), slices.end(), 0.0);
}

double Problem::WeightOfRange(double share) const
{
  const Weights& weights = this->settings.weights;
  return this->majorant > 0 ? share * (weights.view + weights.light) / double(this->majorant) : 0.0;
}

double Problem::SmoothingStrength() const
{
  return this->WeightOfRange(this->settings.smoothness);
}

double Problem::CoherenceWeight() const
{
  return this->previous ? this->WeightOfRange(this->settings.temporalCoherence * this->nearness)
                        : 0.0;
}

double Problem::Regularization(double weight, double squares) const
{
  return 0.5 * weight * this->grid.CellVolume() * squares;
}

void Problem::TakeIntoBounds(std::vector<float>& extinction) const
{
  const ExtinctionBounds<float> bounds = BoundsOf(*this);
  ParallelFor(static_cast<Index>(extinction.size()), 65536,
    [&](Index voxel)
    {
      float& value = extinction[std::size_t(voxel)];
      const float base = this->baseExtinction[voxel];
      const float important = this->importance[voxel];
      const bool empty = !(base > 0) && !(important > 0);
      value = empty ? 0.0f : bounds.Clamp(value, important, base);
    });
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
