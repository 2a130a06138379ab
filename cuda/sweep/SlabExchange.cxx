// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/SlabExchange.h"

#include "sweep/BandDecomposition.h"

#include <algorithm>
#include <utility>

namespace limpid
{
namespace
{
int NodeOf(const Slice& slice)
{
  return slice.node < 0 ? slice.nodes[0] : slice.node;
}

/// Widens a box by `margin` columns and rows on either side.
void Grow(const FaceFrustum& frustum, int margin, NodeBox& box)
{
  if (margin > 0 && !box.Empty())
  {
    Range<int>& columns = box.along[std::size_t(frustum.axisU)];
    Range<int>& rows = box.along[std::size_t(frustum.axisV)];
    columns = Grown(columns, margin, frustum.nodesU);
    rows = Grown(rows, margin, frustum.nodesV);
  }
}
}

FieldLayout::FieldLayout(const NodeBox& box, std::vector<Region> had, std::vector<Region> returned)
  : first(0)
  , stride(FieldView::Whole(nullptr, box.Size()).stride)
  , kept(std::move(had))
  , wanted(std::move(returned))
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->first -= box.Empty() ? 0 : box.along[axis].begin * this->stride[axis];
  }
}

std::vector<Range<int>> SlabsOf(const FaceFrustum& frustum, bool copied)
{
  if (!copied)
  {
    return { { 0, frustum.SliceCount() } };
  }
  std::vector<Range<int>> slabs;
  for (int s = 0; s < frustum.SliceCount(); ++s)
  {
    const int node = frustum.SliceAt(s).node;
    const int first = slabs.empty() ? -1 : frustum.SliceAt(slabs.back().begin).node;
    if (first >= 0 && first / slicesCopied == node / slicesCopied)
    {
      slabs.back().end = s + 1;
    }
    else
    {
      slabs.push_back({ s, s + 1 });
    }
  }
  return slabs;
}

Range<int> NodesOf(const FaceFrustum& frustum, const Range<int>& slices)
{
  Range<int> nodes;
  for (int s = slices.begin; s < slices.end; ++s)
  {
    const int node = NodeOf(frustum.SliceAt(s));
    nodes = Hull(nodes, { node, node + 1 });
  }
  return nodes;
}

Range<int> HullOf(const FaceFrustum& frustum, const Range<int>& slices, Range<int> Slice::*part)
{
  Range<int> hull;
  for (int s = slices.begin; s < slices.end; ++s)
  {
    hull = Hull(hull, frustum.SliceAt(s).*part);
  }
  return hull;
}

SlabExchange::SlabExchange(const FaceFrustum& frustum, const BandDecomposition& bands,
  const FieldLayout& home, const Occupancy* filled, const std::shared_ptr<ExchangeBuffers>& room,
  int margin)
  : Home(home)
  , ReadBeside(margin)
{
  std::vector<Region> needed;
  std::vector<Region> changed;
  for (int rank = 0; rank < bands.Ranks().Size(); ++rank)
  {
    needed.push_back(NeededRegion(frustum, bands, rank));
    for (NodeBox& box : needed.back())
    {
      Grow(frustum, margin, box);
    }
    changed.push_back(OwnedRegion(frustum, bands, rank));
  }
  // Restricts all regions to the slices and to their columns and rows.
  const auto part = [&](std::vector<Region> regions, const Range<int>& slices,
                      Range<int> Slice::*columns, Range<int> Slice::*rows)
  {
    NodeBox box;
    box.along[std::size_t(frustum.axisU)] = HullOf(frustum, slices, columns);
    box.along[std::size_t(frustum.axisV)] = HullOf(frustum, slices, rows);
    box.along[std::size_t(frustum.axisW)] = NodesOf(frustum, slices);
    Grow(frustum, margin, box);
    for (Region& region : regions)
    {
      region = Intersection(region, box);
    }
    return regions;
  };
  const auto pass = [&](const std::vector<Region>& from, const std::vector<Region>& to)
  {
    return ExchangePlan(
      bands.Ranks(), from, to, filled, room, ExchangePlan::Keep::Boxes, frustum.axisU);
  };
  for (const Range<int>& slab : SlabsOf(frustum, true))
  {
    const Range<int> read{ std::max(slab.begin - mostSlicesInFront, 0),
      std::min(slab.end + mostSlicesBehind, frustum.SliceCount()) };
    this->All.push_back(
      { slab, pass(home.kept, part(needed, read, &Slice::touchedColumns, &Slice::touchedRows)),
        pass(part(changed, slab, &Slice::ownedColumns, &Slice::ownedRows), home.wanted) });
  }
}

const SlabExchange::Ways& SlabExchange::WaysOf(const Range<int>& slab) const
{
  return *std::find_if(this->All.begin(), this->All.end(),
    [&slab](const Ways& ways) { return ways.slab.begin == slab.begin; });
}

void SlabExchange::Bring(const Range<int>& slab, const std::vector<Field>& fields) const
{
  std::vector<ExchangePlan::Field> passing(fields.size());
  std::transform(fields.begin(), fields.end(), passing.begin(),
    [this](const Field& field) {
      return ExchangePlan::Field{ this->Home.On(field.field), field.window };
    });
  this->WaysOf(slab).there.Bring(passing);
}

void SlabExchange::Return(const Range<int>& slab, const std::vector<Field>& fields) const
{
  std::vector<ExchangePlan::Field> passing(fields.size());
  std::transform(fields.begin(), fields.end(), passing.begin(),
    [this](const Field& field) {
      return ExchangePlan::Field{ field.window, this->Home.On(field.field) };
    });
  this->WaysOf(slab).back.Bring(passing);
}
}
