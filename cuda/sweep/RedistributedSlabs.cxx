// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/BandDecomposition.h"
#include "sweep/CopiedSlabs.h"

#include <algorithm>
#include <map>
#include <utility>

namespace limpid
{
FieldLayout::FieldLayout(const Communicator& among, const NodeBox& box, std::vector<Region> had,
  std::vector<Region> returned)
  : ranks(&among)
  , first(0)
  , stride(FieldView::Whole(nullptr, box.Size()).stride)
  , kept(std::move(had))
  , wanted(std::move(returned))
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->first -= box.Empty() ? 0 : box.along[axis].begin * this->stride[axis];
  }
}

namespace
{
/// Copies of slices whose owners outside of sweeps are other ranks.
class RedistributedSlabs : public CopiedSlabs
{
public:
  RedistributedSlabs(const FaceFrustum& frustum, const BandDecomposition& bands,
    const FieldLayout& home, const Occupancy* filled, int margin)
    : CopiedSlabs(frustum, bands, margin)
    , Home(home)
  {
    const auto plan = [&](const std::vector<Region>& from, const std::vector<Region>& to)
    {
      return ExchangePlan(
        *home.ranks, from, to, filled, home.room, ExchangePlan::Keep::Boxes, frustum.axisU);
    };
    std::vector<Region> needed;
    std::vector<Region> changed;
    for (int rank = 0; rank < home.ranks->Size(); ++rank)
    {
      needed.push_back(NeededRegion(frustum, bands, rank, margin));
      changed.push_back(OwnedRegion(frustum, bands, rank));
    }
    for (const Range<int>& slab : this->Slabs())
    {
      this->Plans.emplace(slab.begin,
        PlansOfSlab{ plan(home.kept, this->PartOf(needed, this->BoxRead(slab))),
          plan(this->PartOf(changed, this->BoxOwned(slab)), home.wanted) });
    }
  }

  void Load(const Range<int>& slab, const Occupancy* occupancy, Windows& windows) const override
  {
    const Box box = this->BoxRead(slab);
    std::vector<ExchangePlan::Field> fields;
    for (SliceWindow& window : windows)
    {
      Move(window, box.nodes);
      this->ForFilledRows(box, occupancy,
        [&](int v, const Range<int>& columns)
        {
          window.memory->ClearRow(v, {}, 0);
          window.memory->ClearRow(v, columns, box.nodes.Length()); // will have been written
        });
      if (window.use.reads)
      {
        fields.push_back({ this->Home.On(window.field), this->ViewOf(window) });
      }
    }
    this->Plans.at(slab.begin).there.Bring(fields);
  }

  void Store(const Range<int>& slab, const Occupancy*, const Windows& windows) const override
  {
    std::vector<ExchangePlan::Field> fields;
    for (const SliceWindow& window : windows)
    {
      if (window.use.writes)
      {
        fields.push_back({ this->ViewOf(window), this->Home.On(window.field) });
      }
    }
    this->Plans.at(slab.begin).back.Bring(fields);
  }

private:
  struct PlansOfSlab
  {
    ExchangePlan there;
    ExchangePlan back;
  };

  std::vector<Region> PartOf(std::vector<Region> regions, const Box& box) const
  {
    const NodeBox part = BoxOf(this->Frustum, box.columns, box.rows, box.nodes);
    for (Region& region : regions)
    {
      region = Intersection(region, part);
    }
    return regions;
  }

  /// Returns the copied slices as a field.
  FieldView ViewOf(const SliceWindow& window) const
  {
    FieldView view{ window.values, {} };
    view.stride[std::size_t(this->Frustum.axisU)] = 1;
    view.stride[std::size_t(this->Frustum.axisV)] = window.strideV;
    view.stride[std::size_t(this->Frustum.axisW)] = window.strideW;
    return view;
  }

  FieldLayout Home;
  std::map<int, PlansOfSlab> Plans; ///< by the first slice of the slab
};
}

std::unique_ptr<FieldSlabs> FieldSlabs::Redistributed(const FaceFrustum& frustum,
  const BandDecomposition& bands, const FieldLayout& home, const Occupancy* filled, int margin)
{
  return std::make_unique<RedistributedSlabs>(frustum, bands, home, filled, margin);
}
}
