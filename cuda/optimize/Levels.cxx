// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Levels.h"

#include "backend/HostDevice.h"
#include "optimize/AxisFilter.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
AxisFilter::AxisFilter(int from, int to)
  : begin{ 0 }
{
  const double ratio = to > 1 ? (from - 1.0) / (to - 1.0) : 1.0;
  const double width = std::max(ratio, 1.0);
  for (int node = 0; node < to; ++node)
  {
    const double centre = node * ratio;
    const int low = std::max(0, static_cast<int>(std::ceil(centre - width)));
    const int high = std::min(from - 1, static_cast<int>(std::floor(centre + width)));
    double sum = 0;
    for (int source = low; source <= high; ++source)
    {
      const double weight = std::max(0.0, 1.0 - std::abs(source - centre) / width);
      this->weights.push_back(static_cast<float>(weight));
      sum += weight;
    }
    for (auto weight = std::size_t(this->begin.back()); weight < this->weights.size(); ++weight)
    {
      this->weights[weight] = static_cast<float>(this->weights[weight] / sum);
    }
    this->first.push_back(low);
    this->begin.push_back(static_cast<int>(this->weights.size()));
  }
}

Grid CoarseGrid(const Grid& grid, int factor)
{
  Grid coarse = grid;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int cells = grid.nodes[axis] - 1;
    const int coarseCells = cells > 0 ? std::max(1, (cells + factor - 1) / factor) : 0;
    coarse.nodes[axis] = coarseCells + 1;
    coarse.spacing[axis] =
      cells > 0 ? grid.spacing[axis] * cells / coarseCells : grid.spacing[axis];
  }
  return coarse;
}

std::vector<float> Resampled(const Grid& from, const float* field, const Grid& to)
{
  std::vector<float> values(static_cast<std::size_t>(to.NodeCount()));
  Resample(HostDevice::Shared(), from, field, to, values.data());
  return values;
}

std::vector<float> Restrict(const Grid& fine, const float* field, const Grid& coarse)
{
  return Resampled(fine, field, coarse);
}

std::vector<float> Prolong(const Grid& coarse, const float* field, const Grid& fine)
{
  return Resampled(coarse, field, fine);
}
}
