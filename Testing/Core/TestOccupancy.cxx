// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "scene/Occupancy.h"

#include <gtest/gtest.h>

#include <vector>

using namespace limpid;

namespace
{
struct Fields
{
  Grid grid;
  std::vector<float> extinction;
  std::vector<float> importance;

  std::size_t At(const Int3& node) const
  {
    return static_cast<std::size_t>(
      (Index(node.z) * this->grid.nodes.y + node.y) * this->grid.nodes.x + node.x);
  }

  /// Voxels that are one in `share` of all, in no order; both fields have their own.
  Fields(const Int3& nodes, unsigned share)
  {
    this->grid.nodes = nodes;
    unsigned state = 12345;
    for (Index node = 0; node < this->grid.NodeCount(); ++node)
    {
      state = state * 1664525u + 1013904223u;
      this->extinction.push_back((state >> 8) % share == 0 ? 1.5f : 0.0f);
      this->importance.push_back((state >> 9) % (3 * share) == 1 ? 0.5f : 0.0f);
    }
  }
};

/// From the first to the last of `count` voxels that is marked.
template <class Marked>
Range<int> SpanOf(int count, const Marked& marked)
{
  Range<int> span;
  for (int i = 0; i < count; ++i)
  {
    span = marked(i) ? Hull(span, { i, i + 1 }) : span;
  }
  return span;
}

void ExpectEqual(
  const Range<int>& actual, const Range<int>& expected, int alongAxis, const Int3& row)
{
  EXPECT_EQ(actual.begin, expected.begin)
    << "row along " << alongAxis << " at " << row.x << ", " << row.y << ", " << row.z;
  EXPECT_EQ(actual.end, expected.end)
    << "row along " << alongAxis << " at " << row.x << ", " << row.y << ", " << row.z;
}

/// Compares the row of voxels along an axis through `row`.
void ExpectSpans(const Fields& fields, const Occupancy& occupancy, int alongAxis, Int3 row)
{
  const auto valueAt = [&](const std::vector<float>& field, int i)
  {
    row[alongAxis] = i;
    return field[fields.At(row)];
  };
  const int count = fields.grid.nodes[alongAxis];
  const Range<int> filled = SpanOf(count,
    [&](int i) { return valueAt(fields.extinction, i) > 0 || valueAt(fields.importance, i) > 0; });
  const Range<int> important =
    SpanOf(count, [&](int i) { return valueAt(fields.importance, i) > 0; });
  const Occupancy::Spans& spans = occupancy.Row(alongAxis, row[1 - alongAxis], row.z);
  ExpectEqual(spans.filled, filled, alongAxis, row);
  ExpectEqual(spans.important, important, alongAxis, row);
}
}

TEST(Occupancy, KnowsTheSpansOfAllRowsAlongBothAxes)
{
  for (const Int3& nodes : { Int3(37, 20, 9), Int3(16, 5, 4), Int3(3, 70, 6), Int3(1, 1, 1) })
  {
    for (const unsigned share : { 2u, 40u, 100000u })
    {
      const Fields fields(nodes, share);

      const Occupancy occupancy(
        fields.grid, fields.extinction.data(), fields.importance.data(), true);

      for (int z = 0; z < nodes.z; ++z)
      {
        for (int y = 0; y < nodes.y; ++y)
        {
          ExpectSpans(fields, occupancy, 0, Int3(0, y, z));
        }
        for (int x = 0; x < nodes.x; ++x)
        {
          ExpectSpans(fields, occupancy, 1, Int3(x, 0, z));
        }
      }
    }
  }
}

TEST(Occupancy, CountsWhatIsFilledWhetherItSkipsOrNot)
{
  const Fields fields(Int3(37, 20, 9), 7);
  Index filled = 0;
  for (std::size_t node = 0; node < fields.extinction.size(); ++node)
  {
    filled += fields.extinction[node] > 0 || fields.importance[node] > 0 ? 1 : 0;
  }

  for (const bool skip : { true, false })
  {
    const Occupancy occupancy(
      fields.grid, fields.extinction.data(), fields.importance.data(), skip);
    EXPECT_EQ(occupancy.FilledVoxels(), filled);
  }
}
