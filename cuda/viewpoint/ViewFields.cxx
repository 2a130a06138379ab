// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/ViewFields.h"

#include "backend/Backend.h"
#include "distributed/EvenSlabs.h"
#include "distributed/Neighbourhood.h"
#include "distributed/OccupancyOnRanks.h"
#include "energy/NodeImportance.h"

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

/// Returns the box of nonempty nodes, widened by one node on either side if possible, as fields
/// are linear between nodes.
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

/// The order of axes: original, or with the first and last axis exchanged.
enum class Axes
{
  Straight,
  Exchanged
};

Grid GridOf(const Grid& whole, const IndexBox& box, Axes axes)
{
  Grid grid = whole;
  grid.nodes = box.end - box.begin;
  grid.origin = whole.PointToWorld(Vec3(box.begin));
  if (axes == Axes::Exchanged)
  {
    std::swap(grid.nodes.x, grid.nodes.z);
    std::swap(grid.spacing.x, grid.spacing.z);
    std::swap(grid.direction[0], grid.direction[2]);
  }
  return grid;
}

SweptFields Copy(const Grid& grid, const ViewedFields& viewed, const IndexBox& box, Axes axes)
{
  SweptFields fields;
  fields.grid = GridOf(grid, box, axes);
  if (!fields.grid.HasVolume())
  {
    return fields;
  }
  const auto count = static_cast<std::size_t>(fields.grid.NodeCount());
  fields.extinction.resize(count);
  fields.importance.resize(count);
  fields.base.resize(viewed.base ? count : 0);
  fields.least.resize(viewed.least ? count : 0);
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
        if (viewed.least)
        {
          fields.least[std::size_t(node)] = viewed.least[source];
        }
      }
    });
  fields.values = { fields.extinction.data(), fields.importance.data(),
    viewed.base ? fields.base.data() : nullptr, nullptr, viewed.attainable,
    viewed.least ? fields.least.data() : nullptr };
  fields.occupancy = std::make_unique<Occupancy>(
    fields.grid, fields.extinction.data(), fields.importance.data(), true);
  return fields;
}

/// Converts a box of the whole grid to indices in the cropped grid.
NodeBox InCut(const NodeBox& box, const IndexBox& cut, Axes axes)
{
  NodeBox inside;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Range<int> both =
      Intersection(box.along[std::size_t(axis)], Range<int>{ cut.begin[axis], cut.end[axis] });
    const int number = axes == Axes::Exchanged ? 2 - axis : axis;
    inside.along[std::size_t(number)] = both.Empty()
      ? Range<int>{}
      : Range<int>{ both.begin - cut.begin[axis], both.end - cut.begin[axis] };
  }
  return inside;
}

/// Refers to the subdomains of the ranks in place.
SweptFields Share(const Grid& grid, const ViewedFields& viewed, const IndexBox& cut, Axes axes)
{
  const ScenePiece& piece = *viewed.piece;
  SweptFields fields;
  fields.grid = GridOf(grid, cut, axes);
  fields.values = viewed;
  fields.values.extinction = There(viewed.extinction);
  fields.values.importance = There(viewed.importance);
  const bool hasBase = piece.ranks->AnyOf(viewed.base != nullptr);
  fields.values.base = hasBase ? There(viewed.base) : nullptr;
  const bool hasLeast = piece.ranks->AnyOf(viewed.least != nullptr);
  fields.values.least = hasLeast ? There(viewed.least) : nullptr;
  if (!fields.grid.HasVolume())
  {
    return fields;
  }
  std::vector<Region> owned;
  for (const NodeBox& box : piece.owned)
  {
    owned.push_back({ InCut(box, cut, axes) });
  }
  const NodeBox own = InCut(piece.Owned(), cut, axes);
  auto home = std::make_unique<FieldLayout>(
    *piece.ranks, piece.nodes, std::move(owned), std::vector<Region>());
  home->wanted.resize(piece.owned.size());
  for (int axis = 0; axis < 3; ++axis)
  {
    home->first += cut.begin[axis] * home->stride[std::size_t(axis)];
  }
  if (axes == Axes::Exchanged)
  {
    std::swap(home->stride[0], home->stride[2]);
  }
  fields.occupancy = std::make_unique<Occupancy>(OccupancyOnRanks(*piece.ranks, fields.grid, own,
    home->On(const_cast<float*>(fields.values.extinction)),
    home->On(const_cast<float*>(fields.values.importance)), true));
  fields.home = std::move(home);
  return fields;
}

/// Returns the occupancy of the visible structures in the whole grid.
Occupancy OccupancyOf(const Grid& grid, const ScenePiece& piece, const ViewedFields& viewed)
{
  const auto view = [&piece](const float* field)
  { return FieldView::Part(const_cast<float*>(field), piece.nodes); };
  return OccupancyOnRanks(
    *piece.ranks, grid, piece.Owned(), view(viewed.extinction), view(viewed.importance), true);
}

/// Sums over all ranks; rows of slabs are complete.
double ImportantExtinctionOf(const Grid& grid, const ScenePiece& piece, const ViewedFields& viewed)
{
  const float* base = viewed.base ? viewed.base : viewed.extinction;
  const std::vector<NodeBox> slabs = EvenSlabs(*piece.ranks, grid.nodes);
  const auto rank = std::size_t(piece.ranks->Rank());
  const NodeBox own = slabs[rank];
  const std::vector<NodeBox> wanted = WithGhosts(slabs, 1, grid.nodes);
  const FieldInBox bases = FieldIn(piece, wanted, base);
  const FieldInBox importances = FieldIn(piece, wanted, viewed.importance);
  std::vector<double> rows(std::size_t(grid.nodes.y) * std::size_t(grid.nodes.z), 0.0);
  if (!own.Empty())
  {
    FillRowsOfImportantExtinction(
      grid, wanted[rank].along[2], own.along[2], bases.Data(), importances.Data(), rows.data());
  }
  piece.ranks->Gather(rows.data(), rows.size());
  return SumOfRows(grid, rows);
}

void AddParts(const SweptFields& fields, const Camera& camera, double rayDensity,
  const std::array<bool, 3>& depthAxes, std::vector<ViewFields::Part>& parts)
{
  const RaySource eye = SourceOfCamera(camera, fields.grid, false);
  for (PlannedFrustum& outline : OutlineSweep(
         fields.grid, eye, { rayDensity, RayPlacement::ForIntegrals, Readers::Rays, depthAxes }))
  {
    parts.push_back({ &fields, std::move(outline) });
  }
}
}

ViewFields::ViewFields(const Grid& grid, const ViewedFields& viewed)
  : Here(OrWhole(viewed.piece, grid))
  , Important(ImportantExtinctionOf(grid, *this->Here, viewed))
{
  const IndexBox box = FilledBox(grid, OccupancyOf(grid, *this->Here, viewed));
  const auto make = this->Here->IsWhole() ? Copy : Share;
  this->Straight = make(grid, viewed, box, Axes::Straight);
  this->Exchanged = make(grid, viewed, box, Axes::Exchanged);
}

bool ViewFields::AreShared() const
{
  return !this->Here->ranks->IsAlone();
}

bool ViewFields::AnyOf(bool here) const
{
  return this->Here->ranks->AnyOf(here);
}

std::string ViewFields::Describe(const std::string& backend) const
{
  return NameOnRanks(backend, *this->Here->ranks);
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
