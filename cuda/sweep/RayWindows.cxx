// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/RayWindows.h"

#include <algorithm>
#include <array>

namespace limpid
{
namespace
{
/// All rays are described unless that is more than this many times as much as needed. It keeps the
/// plans of ordinary images as simple as possible.
constexpr double leastSaving = 8;

/// So many rays or fewer always have values, 90 MB: a GPU, which has all or none, can sweep them.
constexpr Index few = Index(1) << 20;

/// How far beside the box a ray is still described or visited.
struct Margin
{
  double nodes; ///< distance [index]
  int rays;     ///< number of rays beyond it
};

/// Rays that are described, and visited, in images that are not long: it is simplest, and they
/// are few.
constexpr Margin generous{ 3, 3 };

/// Entries and exits of rays are rounded.
constexpr Margin inside{ 0.01, 0 };

/// In a long image most rays are beside it, so that they determine the time of a sweep. A voxel
/// interpolates one ray beside the box, or with cubics two.
Margin ReadByVoxels(const PlanSettings& settings)
{
  const bool cubic = settings.placement == RayPlacement::ForNodes;
  return { inside.nodes, settings.readers == Readers::Rays ? 0 : cubic ? 2 : 1 };
}

/// Sets the rays of all slices along one axis that are in a margin on the slice, or in another one
/// on the next slice. A ray moves by at most one node per layer, so these include all rays that
/// meet the box in the layer.
void FindNear(const Lateral& lateral, const Margin& here, const Margin& behind,
  std::vector<Slice>& slices, Range<int> Slice::*rays)
{
  const auto near = [&lateral](const Slice& slice, const Margin& margin)
  { return lateral.RaysNear(slice.depth, margin.nodes, margin.rays); };
  for (std::size_t s = 0; s < slices.size(); ++s)
  {
    const Slice& next = slices[std::min(s + 1, slices.size() - 1)];
    slices[s].*rays = Hull(near(slices[s], here), near(next, behind));
  }
}
}

bool IsLong(const Int3& nodes)
{
  constexpr double leastRatio = 4;
  std::array<int, 3> sizes{ { nodes.x, nodes.y, nodes.z } };
  std::sort(sizes.begin(), sizes.end());
  return sizes[2] - 1 > leastRatio * (sizes[1] - 1);
}

RayWindows::RayWindows(const PlannedFrustum& frustum, const Int3& nodes,
  const PlanSettings& settings, std::vector<Slice>& slices)
  : rowColumns(std::size_t(frustum.rows))
  , rowLayers(std::size_t(frustum.rows))
{
  const bool isLong = IsLong(nodes);
  const Margin described = isLong ? Margin{ inside.nodes, generous.rays } : generous;
  FindNear(frustum.lateralU, described, described, slices, &Slice::rayColumns);
  FindNear(frustum.lateralV, described, described, slices, &Slice::rayRows);
  const Margin visited = ReadByVoxels(settings);
  FindNear(frustum.lateralU, visited, inside, slices, &Slice::nearColumns);
  FindNear(frustum.lateralV, visited, inside, slices, &Slice::nearRows);
  const double all = double(frustum.columns) * frustum.rows;
  double needed = 0;
  for (const Slice& slice : slices)
  {
    needed += double(slice.rayColumns.Length()) * slice.rayRows.Length();
  }
  const bool describesAll = all * double(slices.size()) < leastSaving * needed;
  for (std::size_t s = 0; s < slices.size(); ++s)
  {
    Slice& slice = slices[s];
    if (describesAll)
    {
      slice.rayColumns = { 0, frustum.columns };
      slice.rayRows = { 0, frustum.rows };
    }
    if (!isLong)
    {
      slice.nearColumns = slice.rayColumns;
      slice.nearRows = slice.rayRows;
    }
    this->mostColumns = std::max(this->mostColumns, slice.rayColumns.Length());
    this->mostRows = std::max(this->mostRows, slice.rayRows.Length());
    for (int row = slice.rayRows.begin; row < slice.rayRows.end; ++row)
    {
      Range<int>& columns = this->rowColumns[std::size_t(row)];
      columns = Hull(columns, slice.rayColumns);
    }
    for (int row = slice.nearRows.begin; row < slice.nearRows.end; ++row)
    {
      Range<int>& layers = this->rowLayers[std::size_t(row)];
      layers = Hull(layers, { static_cast<int>(s), static_cast<int>(s) + 1 });
    }
  }
  for (const Range<int>& columns : this->rowColumns)
  {
    this->rays += columns.Length();
  }
  this->banded = all > few && all > leastSaving * this->rays;
  if (!this->banded)
  {
    this->rays = all;
    std::fill(this->rowColumns.begin(), this->rowColumns.end(), Range<int>{ 0, frustum.columns });
  }
}
}
