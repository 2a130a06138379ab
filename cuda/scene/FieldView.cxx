// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "scene/FieldView.h"

namespace limpid
{
std::vector<Region> RegionsOf(const std::vector<NodeBox>& boxes)
{
  std::vector<Region> regions;
  regions.reserve(boxes.size());
  for (const NodeBox& box : boxes)
  {
    regions.push_back({ box });
  }
  return regions;
}

Region Intersection(const Region& region, const NodeBox& box)
{
  Region inside;
  for (const NodeBox& some : region)
  {
    const NodeBox both = Intersection(some, box);
    if (!both.Empty())
    {
      inside.push_back(both);
    }
  }
  return inside;
}

void FillNodes(const NodeBox& box, float value, const FieldView& field)
{
  ForRowsOf(box, nullptr,
    [&](const Int3& first, int count)
    {
      const RowInField here(field, first);
      for (int i = 0; i < count; ++i)
      {
        here.first[i * here.stride] = value;
      }
    });
}

void CopyNodes(
  const NodeBox& box, const FieldView& from, const FieldView& to, const Occupancy* filled, int axis)
{
  ForRowsOf(
    box, filled,
    [&](const Int3& first, int count)
    {
      const RowInField there(to, first, axis);
      const RowInField here(from, first, axis);
      if (there.stride == 1)
      {
        here.CopyTo(there.first, count);
        return;
      }
      for (int i = 0; i < count; ++i)
      {
        there.first[i * there.stride] = here.first[i * here.stride];
      }
    },
    axis);
}
}
