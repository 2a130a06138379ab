// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "distributed/OccupancyOnRanks.h"

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace limpid
{
namespace
{
constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();

/// The spans of rows of voxels, as begins and negative ends, so that minima over ranks are hulls.
class SpanEnds
{
public:
  explicit SpanEnds(std::size_t rows)
    : Ends(4 * rows, none)
  {
  }

  /// Sets the spans of a row, moved by `offset`.
  void Set(std::size_t row, const Occupancy::Spans& spans, int offset)
  {
    this->Put(4 * row, spans.filled, offset);
    this->Put(4 * row + 2, spans.important, offset);
  }

  Occupancy::Spans Row(std::size_t row) const
  {
    return { this->At(4 * row), this->At(4 * row + 2) };
  }

  void Reduce(const Communicator& ranks) { ranks.TakeLeast(this->Ends.data(), this->Ends.size()); }

private:
  void Put(std::size_t at, const Range<int>& span, int offset)
  {
    if (!span.Empty())
    {
      this->Ends[at] = span.begin + offset;
      this->Ends[at + 1] = -(span.end + offset);
    }
  }

  Range<int> At(std::size_t at) const
  {
    return this->Ends[at] == none ? Range<int>{}
                                  : Range<int>{ this->Ends[at], -this->Ends[at + 1] };
  }

  std::vector<std::int32_t> Ends;
};

/// Returns the occupancy of a box of nodes.
Occupancy OccupancyOf(
  const Grid& grid, const NodeBox& box, const FieldView& extinction, const FieldView& importance)
{
  const auto valuesOf = [&box](const FieldView& view)
  {
    std::vector<float> values(std::size_t(box.Count()));
    CopyNodes(box, view, FieldView::Part(values.data(), box));
    return values;
  };
  const std::vector<float> extinctions = valuesOf(extinction);
  const std::vector<float> importances = valuesOf(importance);
  Grid part = grid;
  part.nodes = box.Size();
  return { part, extinctions.data(), importances.data(), true };
}
}

Occupancy OccupancyOnRanks(const Communicator& ranks, const Grid& grid, const NodeBox& box,
  const FieldView& extinction, const FieldView& importance, bool skip)
{
  const Int3& nodes = grid.nodes;
  const auto isWhole = [&nodes](const FieldView& view)
  { return view.stride == FieldView::Whole(view.values, nodes).stride; };
  if (ranks.IsAlone() && box == NodeBox::Of(nodes) && isWhole(extinction) && isWhole(importance))
  {
    return { grid, extinction.values, importance.values, skip };
  }
  const std::size_t rowsAlongX = std::size_t(nodes.y) * nodes.z;
  const std::size_t rowsAlongY = std::size_t(nodes.x) * nodes.z;
  SpanEnds ends(rowsAlongX + rowsAlongY);
  std::int64_t filled = 0;
  if (!box.Empty())
  {
    const Occupancy here = OccupancyOf(grid, box, extinction, importance);
    filled = here.FilledVoxels();
    const auto& [x, y, z] = box.along;
    for (int k = z.begin; k < z.end; ++k)
    {
      for (int j = y.begin; j < y.end; ++j)
      {
        ends.Set(std::size_t(k) * nodes.y + j, here.Row(0, j - y.begin, k - z.begin), x.begin);
      }
      for (int i = x.begin; i < x.end; ++i)
      {
        ends.Set(rowsAlongX + std::size_t(k) * nodes.x + i, here.Row(1, i - x.begin, k - z.begin),
          y.begin);
      }
    }
  }
  ends.Reduce(ranks);
  ranks.Sum(&filled, 1);
  std::vector<Occupancy::Spans> alongX(rowsAlongX);
  std::vector<Occupancy::Spans> alongY(rowsAlongY);
  for (std::size_t row = 0; row < rowsAlongX + rowsAlongY; ++row)
  {
    (row < rowsAlongX ? alongX[row] : alongY[row - rowsAlongX]) = ends.Row(row);
  }
  return { grid, std::move(alongX), std::move(alongY), filled, skip };
}
}
