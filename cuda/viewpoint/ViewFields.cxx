// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/ViewFields.h"

#include "backend/Backend.h"

#include <algorithm>
#include <utility>

namespace limpid
{
namespace
{
struct IndexBox
{
  Int3 begin{ 0 };
  Int3 end{ 0 };
};

/// The nodes that are not empty and one more on either side, where there is one: fields are linear
/// between nodes.
IndexBox FilledBox(const Grid& grid, const Occupancy& occupancy)
{
  Range<int> x;
  Range<int> y;
  Range<int> z;
  for (int k = 0; k < grid.nodes.z; ++k)
  {
    for (int j = 0; j < grid.nodes.y; ++j)
    {
      const Range<int>& filled = occupancy.Row(0, j, k).filled;
      if (!filled.Empty())
      {
        x = Hull(x, filled);
        y = Hull(y, { j, j + 1 });
        z = Hull(z, { k, k + 1 });
      }
    }
  }
  if (x.Empty())
  {
    return {};
  }
  return { glm::max(Int3(x.begin, y.begin, z.begin) - 1, Int3(0)),
    glm::min(Int3(x.end, y.end, z.end) + 1, grid.nodes) };
}

/// Whether the axes stay as they are or the first and the last are exchanged.
enum class Axes
{
  Straight,
  Exchanged
};

SweptFields Copy(const Grid& grid, const ViewedFields& viewed, const IndexBox& box, Axes axes)
{
  SweptFields fields;
  const Int3 size = box.end - box.begin;
  fields.grid = grid;
  fields.grid.nodes = size;
  fields.grid.origin = grid.PointToWorld(Vec3(box.begin));
  if (axes == Axes::Exchanged)
  {
    std::swap(fields.grid.nodes.x, fields.grid.nodes.z);
    std::swap(fields.grid.spacing.x, fields.grid.spacing.z);
    std::swap(fields.grid.direction[0], fields.grid.direction[2]);
  }
  if (!fields.grid.HasVolume())
  {
    return fields;
  }
  const auto count = static_cast<std::size_t>(fields.grid.NodeCount());
  fields.extinction.resize(count);
  fields.importance.resize(count);
  fields.base.resize(viewed.base ? count : 0);
  const Int3& nodes = fields.grid.nodes;
  ParallelFor(Index(nodes.y) * nodes.z, 16,
    [&](Index row)
    {
      const int j = static_cast<int>(row % nodes.y);
      const int k = static_cast<int>(row / nodes.y);
      const bool straight = axes == Axes::Straight;
      const Int3 first = box.begin + (straight ? Int3(0, j, k) : Int3(k, j, 0));
      const Index step = straight ? 1 : Index(grid.nodes.x) * grid.nodes.y;
      Index source = (Index(first.z) * grid.nodes.y + first.y) * grid.nodes.x + first.x;
      for (Index node = row * nodes.x; node < (row + 1) * nodes.x; ++node, source += step)
      {
        fields.extinction[std::size_t(node)] = viewed.extinction[source];
        fields.importance[std::size_t(node)] = viewed.importance[source];
        if (viewed.base)
        {
          fields.base[std::size_t(node)] = viewed.base[source];
        }
      }
    });
  fields.occupancy = std::make_unique<Occupancy>(
    fields.grid, fields.extinction.data(), fields.importance.data(), true);
  return fields;
}

void AddParts(const SweptFields& fields, const Camera& camera, double rayDensity,
  const std::array<bool, 3>& depthAxes, std::vector<ViewFields::Part>& parts)
{
  const RaySource eye = SourceOfCamera(camera, fields.grid, false);
  for (PlannedFrustum& frustum : PlanSweep(fields.grid, *fields.occupancy, eye,
         { rayDensity, Placement::ForIntegrals, nullptr, Readers::Rays, depthAxes }))
  {
    parts.push_back({ &fields, std::move(frustum) });
  }
}
}

ViewFields::ViewFields(const Grid& grid, const ViewedFields& viewed)
{
  const Occupancy occupancy(grid, viewed.extinction, viewed.importance, true);
  const IndexBox box = FilledBox(grid, occupancy);
  this->Straight = Copy(grid, viewed, box, Axes::Straight);
  this->Exchanged = Copy(grid, viewed, box, Axes::Exchanged);
}

std::vector<ViewFields::Part> ViewFields::PartsOf(const Camera& camera, double rayDensity) const
{
  std::vector<Part> parts;
  if (!this->Straight.occupancy)
  {
    return parts;
  }
  if (!camera.parallel)
  {
    AddParts(this->Straight, camera, rayDensity, { { false, true, true } }, parts);
    AddParts(this->Exchanged, camera, rayDensity, { { false, false, true } }, parts);
    return parts;
  }
  const Vec3 steepness = glm::abs(SourceOfCamera(camera, this->Straight.grid, false).direction);
  if (steepness.x > std::max(steepness.y, steepness.z))
  {
    AddParts(this->Exchanged, camera, rayDensity, { { false, false, true } }, parts);
  }
  else
  {
    const bool alongY = steepness.y >= steepness.z;
    AddParts(this->Straight, camera, rayDensity, { { false, alongY, !alongY } }, parts);
  }
  return parts;
}
}
