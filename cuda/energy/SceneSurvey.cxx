// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "energy/SceneSurvey.h"

#include "backend/Simd.h"
#include "energy/NodeImportance.h"

#include <algorithm>
#include <vector>

namespace limpid
{
namespace
{
/// Extends a range by `count` values.
LIMPID_MULTIVERSION
void ExtendRange(const float* __restrict values, Index count, float most, FieldRange& range)
{
  constexpr int lanes = 32; // independent maxima, as the compiler may not reorder one
  float largest[lanes] = {};
  int invalid[lanes] = {};
  Index first = 0;
  for (; first + lanes <= count; first += lanes)
  {
    for (int i = 0; i < lanes; ++i)
    {
      const float value = values[first + i];
      invalid[i] |= !(value >= 0) | !(value <= most);
      largest[i] = value > largest[i] ? value : largest[i];
    }
  }
  for (int i = 0; first + i < count; ++i)
  {
    const float value = values[first + i];
    invalid[i] |= !(value >= 0) | !(value <= most);
    largest[i] = value > largest[i] ? value : largest[i];
  }
  for (int i = 0; i < lanes; ++i)
  {
    range.largest = largest[i] > range.largest ? largest[i] : range.largest;
    range.valid = range.valid && !invalid[i];
  }
}

FieldRange HullOf(const std::vector<FieldRange>& ranges)
{
  FieldRange hull;
  for (const FieldRange& range : ranges)
  {
    hull.largest = std::max(hull.largest, range.largest);
    hull.valid = hull.valid && range.valid;
  }
  return hull;
}
}

SceneSurvey SurveyScene(const Grid& grid, const float* baseExtinction, float mostExtinction,
  const float* importance, float mostImportance)
{
  const auto slices = static_cast<std::size_t>(grid.nodes.z);
  std::vector<FieldRange> extinctions(slices);
  std::vector<FieldRange> importances(slices);
  OccupancyBuilder builder(grid);
  SceneSurvey survey;
  survey.nodeImportance = NodeValues(grid.NodeCount());
  const float* mean = survey.nodeImportance.Data();
  FillNodeImportanceOfFilled(grid, baseExtinction, importance, survey.nodeImportance.Data(),
    [&](int slice, const Range<int>& rows)
    {
      const Index first = (Index(slice) * grid.nodes.y + rows.begin) * grid.nodes.x;
      const Index count = Index(rows.end - rows.begin) * grid.nodes.x;
      ExtendRange(baseExtinction + first, count, mostExtinction, extinctions[std::size_t(slice)]);
      ExtendRange(importance + first, count, mostImportance, importances[std::size_t(slice)]);
      builder.Add(slice, rows, baseExtinction + first, mean + first);
    });
  survey.extinction = HullOf(extinctions);
  survey.importance = HullOf(importances);
  survey.occupancy = std::make_shared<const Occupancy>(builder.Take(true));
  return survey;
}
}
