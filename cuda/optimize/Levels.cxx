// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Levels.h"

#include "backend/HostDevice.h"
#include "distributed/ExchangePlan.h"
#include "distributed/Slab.h"
#include "optimize/AxisFilter.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
NodeBox SourcesOf(const GridFilter& filter, const NodeBox& box)
{
  return box.Empty() ? NodeBox() : filter.SourcesOf(box);
}

/// `field`: holds only the source nodes of the box.
std::vector<float> Resampled(const GridFilter& filter, const float* field, const NodeBox& box)
{
  std::vector<float> result(std::size_t(box.Count()));
  if (!result.empty())
  {
    Resample(HostDevice::Shared(), filter.PartOf(box), field, result.data());
  }
  return result;
}
}

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

std::vector<float> Resampled(const Grid& from, const float* field, const Grid& to)
{
  std::vector<float> values(static_cast<std::size_t>(to.NodeCount()));
  Resample(HostDevice::Shared(), from, field, to, values.data());
  return values;
}

std::vector<float> ResampledBox(const Communicator& ranks, const Grid& from, const FieldView& field,
  const std::vector<NodeBox>& had, const Grid& to, const std::vector<NodeBox>& wanted)
{
  const GridFilter filter(from.nodes, to.nodes);
  std::vector<NodeBox> needed;
  needed.reserve(wanted.size());
  for (const NodeBox& box : wanted)
  {
    needed.push_back(SourcesOf(filter, box));
  }
  const auto own = std::size_t(ranks.Rank());
  std::vector<float> values(std::size_t(needed[own].Count()));
  Spread(
    ranks, field, RegionsOf(had), FieldView::Part(values.data(), needed[own]), RegionsOf(needed));
  return Resampled(filter, values.data(), wanted[own]);
}

std::vector<float> GatheredResampling(const Communicator& ranks, const Grid& from,
  const FieldView& field, const std::vector<NodeBox>& had, const Grid& to)
{
  const std::vector<NodeBox> slabs = EvenSlabs(ranks, to.nodes);
  std::vector<float> own = ResampledBox(ranks, from, field, had, to, slabs);
  std::vector<float> all(std::size_t(to.NodeCount()));
  Spread(ranks, FieldView::Part(own.data(), slabs[std::size_t(ranks.Rank())]), RegionsOf(slabs),
    FieldView::Whole(all.data(), to.nodes),
    std::vector<Region>(slabs.size(), { NodeBox::Of(to.nodes) }));
  return all;
}

std::vector<float> ResampledBox(
  const Grid& from, const float* field, const Grid& to, const NodeBox& wanted)
{
  const GridFilter filter(from.nodes, to.nodes);
  const NodeBox sources = SourcesOf(filter, wanted);
  std::vector<float> values(std::size_t(sources.Count()));
  CopyNodes(sources, FieldView::Whole(const_cast<float*>(field), from.nodes),
    FieldView::Part(values.data(), sources));
  return Resampled(filter, values.data(), wanted);
}

bool IsForAll(const Communicator& ranks, const Grid& grid, const Grid& full)
{
  constexpr Index few = 1 << 18; // grids this small may always be held completely
  return grid.NodeCount() <= std::max(full.NodeCount() / (4 * Index(ranks.Size())), few);
}

std::vector<float> Restrict(const Grid& fine, const float* field, const Grid& coarse)
{
  return Resampled(fine, field, coarse);
}
}
