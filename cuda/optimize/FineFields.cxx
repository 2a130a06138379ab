// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/FineFields.h"

#include "backend/Backend.h"
#include "backend/HostDevice.h"
#include "energy/Despeckle.h"
#include "energy/NodeImportance.h"
#include "math/Require.h"
#include "optimize/Smoothing.h"
#include "scene/FieldView.h"
#include "scene/Resampling.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace limpid
{
namespace
{
/// A node importance depends on the neighbours of a node, whose despeckled importance depends on
/// theirs. The pull of neighbours depends on their extinction, whose bounds do so, too.
constexpr int margin = 2;

/// One of the 27 nodes around a node and the node itself, which is number 0.
struct Neighbor
{
  static constexpr int count = 27;
  static constexpr int own = count / 2; ///< in the order of addresses

  /// Returns its index in a box of `size` nodes around (x, y, z); nodes on the border are repeated.
  static Index At(int number, int x, int y, int z, const Int3& size)
  {
    const int place = (number + own) % count;
    const auto inside = [](int at, int nodes) { return std::clamp(at, 0, nodes - 1); };
    return (Index(inside(z + place / 9 - 1, size.z)) * size.y +
             inside(y + place / 3 % 3 - 1, size.y)) *
      size.x +
      inside(x + place % 3 - 1, size.x);
  }
};

/// Returns the values in a box of a field that has all nodes.
std::vector<float> PartOf(const float* field, const Int3& nodes, const NodeBox& box)
{
  std::vector<float> part(static_cast<std::size_t>(box.Count()));
  CopyNodes(
    box, FieldView::Whole(const_cast<float*>(field), nodes), FieldView::Part(part.data(), box));
  return part;
}
}

FineFields::FineFields(
  const Grid& data, const FieldsOfBox& ofBox, const CarriedChange& change, float majorant)
  : Data(data)
  , OfBox(&ofBox)
  , Change(&change)
  , Filter(change.grid.nodes, data.nodes)
  , ChangeAt{ majorant }
  , Bounds(BoundsOf(change.settings, majorant))
{
}

bool FineFields::Despeckles() const
{
  return this->Change->settings.importanceSmoothing == ImportanceSmoothing::Median;
}

void FineFields::SetPull(const float* derivative, double strength)
{
  this->Derivative = derivative;
  this->PullStrength = static_cast<float>(strength);
}

bool FineFields::Has(const float* field) const
{
  return std::any_of(
    this->Names.begin(), this->Names.end(), [field](const float& name) { return &name == field; });
}

FieldView FineFields::Values(const float* field)
{
  return FieldView::Part(this->Made[std::size_t(field - this->Names.data())].data(), this->Here);
}

void FineFields::MoveTo(const NodeBox& box, const std::vector<const float*>& fields)
{
  const auto wants = [&](Field field)
  { return std::find(fields.begin(), fields.end(), this->Name(field)) != fields.end(); };
  this->Here = box.Grown(margin, this->Data.nodes);
  if (this->Here.Empty())
  {
    return;
  }
  Grid here = this->Data;
  here.nodes = this->Here.Size();
  const auto count = static_cast<std::size_t>(this->Here.Count());
  this->Of(Field::Base).resize(count);
  this->Of(Field::Given).resize(count);
  (*this->OfBox)(this->Here, this->Of(Field::Base).data(), this->Of(Field::Given).data());
  const bool pulls = wants(Field::Pulled);
  const bool changes = pulls || wants(Field::Changed);
  if (changes || wants(Field::Importance) || wants(Field::NodeImportance) || wants(Field::Least))
  {
    this->FindImportance(here);
  }
  if (wants(Field::NodeImportance))
  {
    this->FindNodeImportance(here, this->Of(Field::Importance), Field::NodeImportance);
  }
  if (wants(Field::NodeImportanceOfGiven))
  {
    this->FindNodeImportance(here, this->Of(Field::Given), Field::NodeImportanceOfGiven);
  }
  if (wants(Field::Least))
  {
    this->FindLeast();
  }
  if (changes)
  {
    this->FindChanged();
  }
  if (pulls)
  {
    this->FindPulled();
  }
}

void FineFields::FindImportance(const Grid& here)
{
  const std::vector<float>& given = this->Of(Field::Given);
  std::vector<float>& importance = this->Of(Field::Importance);
  if (!this->Despeckles())
  {
    importance = given;
    return;
  }
  if (!this->Taken.empty())
  {
    this->RecallImportance();
    return;
  }
  importance.assign(given.size(), 0.0f);
  Despeckle(here, this->Of(Field::Base).data(), given.data(), importance.data());
}

/// Despeckles by what Survey has found.
void FineFields::RecallImportance()
{
  const std::vector<float>& given = this->Of(Field::Given);
  std::vector<float>& importance = this->Of(Field::Importance);
  importance = given;
  const Int3 size = this->Here.Size();
  const Int3 first = this->Here.First();
  ParallelFor(Index(size.y) * size.z, 64,
    [&](Index row)
    {
      const auto y = static_cast<int>(row % size.y);
      const auto z = static_cast<int>(row / size.y);
      const std::uint8_t* taken = this->Taken.data() +
        (Index(first.z + z) * this->Data.nodes.y + first.y + y) * this->Data.nodes.x + first.x;
      for (int x = 0; x < size.x; ++x)
      {
        if (taken[x])
        {
          importance[std::size_t(row * size.x + x)] =
            given[std::size_t(Neighbor::At(taken[x], x, y, z, size))];
        }
      }
    });
}

/// Returns the neighbour whose importance a node of the box has after despeckling.
std::uint8_t FineFields::NeighborTaken(int x, int y, int z)
{
  const Int3 size = this->Here.Size();
  const std::vector<float>& given = this->Of(Field::Given);
  const float wanted = this->Of(Field::Importance)[std::size_t(Neighbor::At(0, x, y, z, size))];
  int number = 0;
  while (
    number < Neighbor::count && given[std::size_t(Neighbor::At(number, x, y, z, size))] != wanted)
  {
    ++number;
  }
  LIMPID_EXPECT(number < Neighbor::count);
  return static_cast<std::uint8_t>(number);
}

void FineFields::FindNodeImportance(
  const Grid& here, const std::vector<float>& importance, Field result)
{
  this->Of(result).assign(importance.size(), 0.0f);
  FillNodeImportanceOfFilled(here, this->Of(Field::Base).data(), importance.data(),
    this->Of(result).data(), [](int, const Range<int>&) {});
}

void FineFields::FindChanged()
{
  const NodeBox sources = this->Filter.SourcesOf(this->Here);
  const std::vector<float> change = ResampledBox(this->Filter,
    PartOf(this->Change->ofExtinction.data(), this->Filter.from, sources).data(), this->Here);
  const float* base = this->Of(Field::Base).data();
  const float* given = this->Of(Field::Given).data();
  const float* importance = this->Of(Field::Importance).data();
  std::vector<float>& changed = this->Of(Field::Changed);
  changed.resize(change.size());
  ParallelFor(static_cast<Index>(change.size()), 65536,
    [&](Index node)
    {
      const float wanted = this->ChangeAt(change[std::size_t(node)], base[node], given[node]);
      changed[std::size_t(node)] = this->Bounds.Within(wanted, importance[node], base[node]);
    });
}

void FineFields::FindLeast()
{
  const std::vector<float>& base = this->Of(Field::Base);
  const std::vector<float>& importance = this->Of(Field::Importance);
  std::vector<float>& least = this->Of(Field::Least);
  least.resize(base.size());
  std::transform(importance.begin(), importance.end(), base.begin(), least.begin(),
    [this](float g, float extinction) { return this->Bounds.protect * g * extinction; });
}

void FineFields::FindPulled()
{
  std::vector<float>& pulled = this->Of(Field::Pulled);
  if (this->Derivative)
  {
    pulled = PartOf(this->Derivative, this->Data.nodes, this->Here);
  }
  else
  {
    pulled.assign(this->Of(Field::Base).size(), 0.0f);
  }
  FindPull(*HostDevice::Shared(),
    { this->Here.Size(), this->Of(Field::Base).data(), this->Of(Field::Importance).data(),
      this->Of(Field::Changed).data(), pulled.data(), this->PullStrength, pulled.data() },
    { 0, this->Here.Size().z });
}

/// Calls what(layer, first) for all layers of nodes along the third axis, with the place of the
/// first of its nodes in the fields that were made.
template <class What>
void FineFields::ForLayers(const std::vector<const float*>& fields, const What& what)
{
  const Int3 nodes = this->Data.nodes;
  const Index perLayer = Index(nodes.x) * nodes.y;
  const int atATime = static_cast<int>(std::max<Index>(NodesAtATime(this->Data) / perLayer, 1));
  for (int begin = 0; begin < nodes.z; begin += atATime)
  {
    NodeBox box = NodeBox::Of(nodes);
    const Range<int> layers{ begin, std::min(begin + atATime, nodes.z) };
    box.along[2] = layers;
    this->MoveTo(box, fields);
    ParallelFor(layers.Length(),
      [&](Index layer)
      {
        const int z = layers.begin + static_cast<int>(layer);
        what(z, std::size_t(perLayer * (z - this->Here.along[2].begin)));
      });
  }
}

void FineFields::Survey()
{
  OccupancyBuilder seen(this->Data);
  OccupancyBuilder ofGiven(this->Data);
  const Int3 nodes = this->Data.nodes;
  std::vector<std::uint8_t> taken(
    this->Despeckles() ? static_cast<std::size_t>(this->Data.NodeCount()) : 0);
  this->ForLayers({ this->NodeImportance(), this->Name(Field::NodeImportanceOfGiven) },
    [&](int layer, std::size_t first)
    {
      const float* base = &this->Of(Field::Base)[first];
      seen.Add(layer, { 0, nodes.y }, base, &this->Of(Field::NodeImportance)[first]);
      ofGiven.Add(layer, { 0, nodes.y }, base, &this->Of(Field::NodeImportanceOfGiven)[first]);
      auto node = taken.begin() + std::ptrdiff_t(layer) * nodes.x * nodes.y;
      for (int y = 0; !taken.empty() && y < nodes.y; ++y)
      {
        for (int x = 0; x < nodes.x; ++x)
        {
          *node++ = this->NeighborTaken(x, y, layer - this->Here.along[2].begin);
        }
      }
    });
  this->Taken = std::move(taken);
  const bool skip = this->Change->settings.skipUnneeded;
  this->Seen = std::make_shared<const Occupancy>(seen.Take(skip));
  this->OfGiven = std::make_shared<const Occupancy>(ofGiven.Take(skip));
}

void FineFields::Fill(const float* field, float* values)
{
  const Index perLayer = Index(this->Data.nodes.x) * this->Data.nodes.y;
  this->ForLayers({ field },
    [&](int layer, std::size_t first)
    {
      const std::vector<float>& made = this->Made[std::size_t(field - this->Names.data())];
      std::copy_n(&made[first], perLayer, values + perLayer * layer);
    });
}
}
