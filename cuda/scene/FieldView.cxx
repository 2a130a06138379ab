// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "scene/FieldView.h"

#include "backend/Backend.h"

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

namespace
{
/// Calls what(part) in parallel for the slices of a box along its last axis.
template <class What>
void ForSlicesOf(const NodeBox& box, const What& what)
{
  constexpr Index nodesPerTask = 65536;
  const Index slices = box.Empty() ? 0 : box.along[2].Length();
  const Index nodes = slices > 0 ? box.Count() / slices : 1;
  ParallelFor(slices, std::max<Index>(nodesPerTask / nodes, 1),
    [&](Index slice)
    {
      NodeBox part = box;
      part.along[2].begin += static_cast<int>(slice);
      part.along[2].end = part.along[2].begin + 1;
      what(part);
    });
}
}

void FillNodes(const NodeBox& box, float value, const FieldView& field)
{
  ForSlicesOf(box,
    [&](const NodeBox& slice)
    {
      ForRowsOf(slice, nullptr,
        [&](const Int3& first, int count)
        {
          const RowInField here(field, first);
          if (here.stride == 1)
          {
            std::fill_n(here.first, count, value);
            return;
          }
          for (int i = 0; i < count; ++i)
          {
            here.first[i * here.stride] = value;
          }
        });
    });
}

void CopyNodes(
  const NodeBox& box, const FieldView& from, const FieldView& to, const Occupancy* filled, int axis)
{
  ForSlicesOf(box,
    [&](const NodeBox& slice)
    {
      ForRowsOf(
        slice, filled,
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
    });
}
}
