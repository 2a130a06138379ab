// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/RayWindows.h"

#include <algorithm>

namespace limpid
{
namespace
{
/// All rays are described unless that is more than this many times as much as needed. It keeps the
/// plans of ordinary images as simple as possible.
constexpr double leastSaving = 8;

/// Sets the windows of all slices along one axis. `window`: Slice::rayColumns or rayRows.
void FindNear(const Lateral& lateral, std::vector<Slice>& slices, Range<int> Slice::*window)
{
  // All rays meet in a point source.
  const auto near = [&](const Slice& slice)
  { return lateral.parallel || slice.depth > 0 ? lateral.RaysNear(slice.depth) : Range<int>{}; };
  Range<int> behind = near(slices.back());
  slices.back().*window = behind;
  for (std::size_t s = slices.size() - 1; s-- > 0;)
  {
    const Range<int> here = near(slices[s]);
    slices[s].*window = Hull(here, behind);
    behind = here;
  }
}
}

RayWindows::RayWindows(const PlannedFrustum& frustum, std::vector<Slice>& slices)
  : rowColumns(std::size_t(frustum.rows))
  , rowLayers(std::size_t(frustum.rows))
{
  FindNear(frustum.lateralU, slices, &Slice::rayColumns);
  FindNear(frustum.lateralV, slices, &Slice::rayRows);
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
    this->mostColumns = std::max(this->mostColumns, slice.rayColumns.Length());
    this->mostRows = std::max(this->mostRows, slice.rayRows.Length());
    for (int row = slice.rayRows.begin; row < slice.rayRows.end; ++row)
    {
      Range<int>& columns = this->rowColumns[std::size_t(row)];
      Range<int>& layers = this->rowLayers[std::size_t(row)];
      columns = Hull(columns, slice.rayColumns);
      layers = Hull(layers, { static_cast<int>(s), static_cast<int>(s) + 1 });
    }
  }
  for (const Range<int>& columns : this->rowColumns)
  {
    this->rays += columns.Length();
  }
  this->banded = all > leastSaving * this->rays;
  if (!this->banded)
  {
    this->rays = all;
    std::fill(this->rowColumns.begin(), this->rowColumns.end(), Range<int>{ 0, frustum.columns });
  }
}
}
