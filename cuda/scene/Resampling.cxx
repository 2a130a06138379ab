// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "scene/Resampling.h"

#include "backend/HostDevice.h"

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

Range<int> AxisFilter::SourcesOf(const Range<int>& nodes) const
{
  if (nodes.Empty())
  {
    return {};
  }
  const auto last = std::size_t(nodes.end) - 1;
  return { this->first[std::size_t(nodes.begin)],
    this->first[last] + this->begin[last + 1] - this->begin[last] };
}

AxisFilter AxisFilter::PartOf(const Range<int>& nodes) const
{
  AxisFilter part = *this;
  const auto begins = this->begin.begin() + nodes.begin;
  const int firstWeight = *begins;
  const int firstSource = this->SourcesOf(nodes).begin;
  part.begin.assign(begins, begins + nodes.Length() + 1);
  part.first.assign(this->first.begin() + nodes.begin, this->first.begin() + nodes.end);
  part.weights.assign(
    this->weights.begin() + firstWeight, this->weights.begin() + part.begin.back());
  for (int& weight : part.begin)
  {
    weight -= firstWeight;
  }
  for (int& source : part.first)
  {
    source -= firstSource;
  }
  return part;
}

GridFilter::GridFilter(const Int3& fromNodes, const Int3& toNodes)
  : from(fromNodes)
  , to(toNodes)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (this->from[axis] != this->to[axis])
    {
      this->along[std::size_t(axis)] = AxisFilter(this->from[axis], this->to[axis]);
    }
  }
}

NodeBox GridFilter::SourcesOf(const NodeBox& nodes) const
{
  if (nodes.Empty())
  {
    return {};
  }
  NodeBox sources = nodes;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (this->along[axis])
    {
      sources.along[axis] = this->along[axis]->SourcesOf(nodes.along[axis]);
    }
  }
  return sources;
}

GridFilter GridFilter::PartOf(const NodeBox& nodes) const
{
  GridFilter part = *this;
  part.from = this->SourcesOf(nodes).Size();
  part.to = nodes.Size();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (this->along[axis])
    {
      part.along[axis] = this->along[axis]->PartOf(nodes.along[axis]);
    }
  }
  return part;
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

std::vector<float> ResampledBox(const GridFilter& filter, const float* field, const NodeBox& box)
{
  std::vector<float> values(std::size_t(box.Count()));
  if (!values.empty())
  {
    Resample(HostDevice::Shared(), filter.PartOf(box), field, values.data());
  }
  return values;
}
}
