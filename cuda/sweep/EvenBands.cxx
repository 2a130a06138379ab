// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/EvenBands.h"

#include "backend/Backend.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace limpid
{
namespace
{
// Times on one processor [ns], fitted to the times of millions of rows of four scenes.
constexpr Index rowOfRays = 150;
constexpr Index voxelRead = 4;   ///< read to interpolate a row of rays
constexpr Index clippedRay = 18; ///< inside the box in a part of the layer only
constexpr Index sideRay = 2;     ///< enters through a side
constexpr Index rowOfVoxels = 40;
constexpr Index rowOfActive = 100; ///< row with active voxels
constexpr Index activeVoxel = 2;
constexpr Index filledVoxel = 2;     ///< includes allocation and packing between sweeps
constexpr Index transposedVoxel = 7; ///< in all fields, see FieldSlabs

/// The work of a stretch in front of every row, and the total.
using WorkBefore = std::vector<Index>;

/// Work of a row of rays in the layer behind a slice, with some active columns.
Index WorkOfRays(const FaceFrustum& frustum, int s, int row, const Range<int>& active)
{
  const Slice& slice = frustum.SliceAt(s);
  const float back = slice.layer.front + slice.layer.thickness;
  const Range<float> stay = frustum.StayOfRow(row);
  const auto lengthOfOthers = [&active](bool any, const Range<int>& columns)
  { return active.Length() - (any ? std::max(Intersection(active, columns).Length(), 0) : 0); };
  const int clipped =
    lengthOfOthers(stay.begin <= slice.layer.front && stay.end >= back, slice.insideColumns);
  const int throughSides = lengthOfOthers(frustum.frontRows.Contains(row), frustum.frontColumns);
  const int* columns = frustum.PlaneColumns(2 * s).index;
  const int read = columns[active.end - 1] + 2 - columns[active.begin];
  return rowOfRays + voxelRead * read + clippedRay * clipped + sideRay * throughSides;
}

/// Work of a row of voxels on a slice, of which `filled` columns may change.
Index WorkOfVoxels(const FaceFrustum& frustum, int s, int v, const Range<int>& filled)
{
  const Range<int> active = frustum.ActiveVoxels(s, v);
  const bool transposed = frustum.axisW == 0;
  return rowOfVoxels + (transposed ? transposedVoxel : filledVoxel) * filled.Length() +
    (active.Empty() ? 0 : rowOfActive + activeVoxel * active.Length());
}

std::vector<WorkBefore> WorkOfStretches(const FaceFrustum& frustum)
{
  const int slices = frustum.SliceCount();
  std::vector<WorkBefore> stretches(std::size_t((slices + slicesPerStretch - 1) / slicesPerStretch),
    WorkBefore(std::size_t(frustum.rows) + 1, 0));
  ParallelFor(static_cast<Index>(stretches.size()),
    [&](Index stretch)
    {
      WorkBefore& work = stretches[std::size_t(stretch)];
      const int first = static_cast<int>(stretch) * slicesPerStretch;
      for (int s = first; s < std::min(first + slicesPerStretch, slices); ++s)
      {
        const std::vector<Index> rows = WorkOfRows(frustum, s);
        std::transform(rows.begin(), rows.end(), work.begin() + 1, work.begin() + 1, std::plus<>());
      }
      std::partial_sum(work.begin(), work.end(), work.begin());
    });
  return stretches;
}

WorkBefore SumOf(const std::vector<WorkBefore>& stretches)
{
  WorkBefore sum(stretches.front().size(), 0);
  for (const WorkBefore& work : stretches)
  {
    std::transform(sum.begin(), sum.end(), work.begin(), sum.begin(), std::plus<>());
  }
  return sum;
}

/// Finds the best positions of one border between bands.
class BorderPath
{
public:
  /// `part` of `parts` shares of the work lie in front of the border. `costOfRow`: cost of moving
  /// a row.
  BorderPath(const std::vector<WorkBefore>& stretches, int part, int parts, Index costOfRow)
    : Stretches(stretches)
    , Part(part)
    , Parts(parts)
    , CostOfRow(costOfRow * parts)
    , Places(stretches.front().size())
    , From(stretches.size() * this->Places)
    , Least(this->Places, 0)
  {
  }

  /// Returns the position on each stretch.
  std::vector<int> Find()
  {
    for (std::size_t stretch = 0; stretch < this->Stretches.size(); ++stretch)
    {
      int* from = this->From.data() + stretch * this->Places;
      std::iota(from, from + this->Places, 0);
      if (stretch > 0)
      {
        this->Pass(from);
      }
      this->AddUnevenness(this->Stretches[stretch]);
    }
    std::vector<int> path(this->Stretches.size());
    auto place = static_cast<int>(
      std::min_element(this->Least.begin(), this->Least.end()) - this->Least.begin());
    for (std::size_t stretch = path.size(); stretch-- > 0;)
    {
      path[stretch] = place;
      place = this->From[stretch * this->Places + std::size_t(place)];
    }
    return path;
  }

private:
  /// Moves to the next stretch from the cheapest position, row by row.
  void Pass(int* from)
  {
    const auto take = [this, from](std::size_t place, std::size_t neighbour)
    {
      const Index cost = this->Least[neighbour] + this->CostOfRow;
      if (cost < this->Least[place])
      {
        this->Least[place] = cost;
        from[place] = from[neighbour];
      }
    };
    for (std::size_t place = 1; place < this->Places; ++place)
    {
      take(place, place - 1);
    }
    for (std::size_t place = this->Places - 1; place-- > 0;)
    {
      take(place, place + 1);
    }
  }

  void AddUnevenness(const WorkBefore& work)
  {
    const Index share = this->Part * work.back();
    for (std::size_t place = 0; place < this->Places; ++place)
    {
      const Index excess = this->Parts * work[place] - share;
      this->Least[place] += excess < 0 ? -excess : excess;
    }
  }

  const std::vector<WorkBefore>& Stretches;
  Index Part;
  Index Parts; ///< costs are multiplied by it to stay integers
  Index CostOfRow;
  std::size_t Places;
  std::vector<int> From;    ///< [stretch][place]: best position on the previous stretch
  std::vector<Index> Least; ///< [place]: cost of the cheapest sequence that ends there
};
}

std::vector<Index> WorkOfRows(const FaceFrustum& frustum, int s)
{
  std::vector<Index> work(std::size_t(frustum.rows), 0);
  const Range<int>& near = frustum.SliceAt(s).rayRows;
  for (int row = near.begin; s < frustum.lastSlice && row < near.end; ++row)
  {
    const Range<int> active = frustum.ActiveRays(s, row);
    work[std::size_t(row)] = active.Empty() ? 0 : WorkOfRays(frustum, s, row, active);
  }
  const Slice& slice = frustum.SliceAt(s);
  if (slice.node >= 0 && frustum.HasVoxels())
  {
    const int* rows = frustum.Row(frustum.voxelRows, s).index;
    for (int v = slice.ownedRows.begin; v < slice.ownedRows.end; ++v)
    {
      const Range<int> filled = frustum.FilledVoxels(s, v);
      work[std::size_t(rows[v])] += filled.Empty() ? 0 : WorkOfVoxels(frustum, s, v, filled);
    }
  }
  return work;
}

std::vector<std::vector<int>> FindEvenBands(const FaceFrustum& frustum, int bands)
{
  std::vector<WorkBefore> stretches = WorkOfStretches(frustum);
  const std::size_t count = stretches.size();
  if (!frustum.HasVoxels())
  {
    stretches = { SumOf(stretches) }; // no band waits for another before the end
  }
  std::vector<std::vector<int>> begins(
    stretches.size(), std::vector<int>(std::size_t(bands) + 1, 0));
  ParallelFor(bands - 1,
    [&](Index border)
    {
      const int part = static_cast<int>(border) + 1;
      const std::vector<int> path =
        BorderPath(stretches, part, bands, timeOfPassing * frustum.columns).Find();
      for (std::size_t stretch = 0; stretch < path.size(); ++stretch)
      {
        begins[stretch][std::size_t(part)] = path[stretch];
      }
    });
  begins.resize(count, begins.front());
  for (std::vector<int>& stretch : begins)
  {
    stretch.back() = frustum.rows;
    std::partial_sum(stretch.begin(), stretch.end(), stretch.begin(),
      [](int one, int other) { return std::max(one, other); });
  }
  return begins;
}
}
