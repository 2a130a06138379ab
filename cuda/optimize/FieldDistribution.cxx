// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/FieldDistribution.h"

#include "distributed/DistributedFields.h"
#include "distributed/EvenSlabs.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
void Append(std::vector<Region>& all, const std::vector<Region>& some)
{
  all.resize(some.size());
  for (std::size_t rank = 0; rank < some.size(); ++rank)
  {
    all[rank].insert(all[rank].end(), some[rank].begin(), some[rank].end());
  }
}

/// Returns the node at a source of rays, which is in none of its frusta; empty if there is none.
NodeBox NodeAt(const RaySource& source, const Int3& nodes)
{
  NodeBox box;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double at = source.parallel ? -1.0 : source.origin[axis];
    const double node = std::round(at);
    const bool isOne =
      std::abs(at - node) <= nearestSlice && node >= 0 && node < double(nodes[axis]);
    const int first = isOne ? static_cast<int>(node) : 0;
    box.along[std::size_t(axis)] = { first, isOne ? first + 1 : first };
  }
  return box;
}
}

FieldDistribution::FieldDistribution(const Communicator& ranks, const Int3& nodes,
  const std::vector<OfTerm>& terms, const Occupancy& filled, bool inSlabs, FieldPlaces places)
  : All(&ranks)
  , Filled(&filled)
  , Nodes(nodes)
{
  for (Place number = 0; number < terms.size(); ++number)
  {
    this->AddTerm(number, terms[number]);
  }
  if (inSlabs)
  {
    this->AddSlabs(1);
  }
  const bool isChosen = places == FieldPlaces::Chosen;
  const auto isSmall = [&] { return isChosen && this->HoldLittleMoreThanAShare(); };
  if (places == FieldPlaces::BesideAllRays || isSmall())
  {
    return;
  }
  this->KeepOnly(inSlabs ? slabs : this->Places.front());
  if (!inSlabs && places != FieldPlaces::BesideFirstRays && !isSmall())
  {
    this->AddSlabs(0);
    this->KeepOnly(slabs);
  }
  this->VisitHome(terms);
}

FieldDistribution::FieldDistribution(const Problem& problem, const std::vector<OfTerm>& terms)
  : All(problem.shared->ranks.get())
  , Filled(problem.occupancy.get())
  , Nodes(problem.grid.nodes)
{
  const DistributedFields& fields = *problem.shared;
  if (fields.AreInPlace())
  {
    this->AddSlabs(0);
    return;
  }
  *this = { *fields.ranks, problem.grid.nodes, terms, *problem.occupancy, fields.inSlabs,
    fields.places };
  this->Wanted = fields.wanted;
  std::vector<Input> inputs;
  const auto add = [&inputs](const DistributedField& field) {
    inputs.push_back({ field.Piece(), field.Values() });
  };
  add(fields.base);
  add(fields.importance);
  add(fields.nodeImportance);
  std::for_each(fields.references.begin(), fields.references.end(), add);
  this->FromPieces(fields.pieces, inputs);
}

/// Calls what(box) for the boxes of nodes that this rank needs in a distribution.
template <class What>
void FieldDistribution::ForNeededHere(std::size_t place, const What& what) const
{
  for (const Regions& frustum : this->Of[place])
  {
    for (const NodeBox& box : frustum.needed[std::size_t(this->All->Rank())])
    {
      what(box);
    }
  }
}

Index FieldDistribution::NodesHeld() const
{
  constexpr Index nodesPerPage = 1024;
  const FieldView numbers = this->Whole(nullptr);
  std::vector<char> held;
  for (std::size_t place = 0; place < this->Of.size(); ++place)
  {
    this->ForNeededHere(place,
      [&](const NodeBox& box)
      {
        ForRowsOf(box, this->Filled,
          [&](const Int3& first, int count)
          {
            const Index node = numbers.At(first.x, first.y, first.z);
            const Index begin = node / nodesPerPage;
            const Index end = (node + count - 1) / nodesPerPage + 1;
            held.resize(std::max(held.size(), std::size_t(end)), 0);
            std::fill(held.begin() + begin, held.begin() + end, char(1));
          });
      });
  }
  return nodesPerPage * std::count(held.begin(), held.end(), char(1));
}

/// Whether a field takes little more memory than an even share, on the rank that needs most.
bool FieldDistribution::HoldLittleMoreThanAShare() const
{
  // Including subdomains and messages, a rank then needs 1.3 times its share of one process's
  // memory.
  constexpr double most = 1.35;
  const double share = double(this->Nodes.x) * this->Nodes.y * this->Nodes.z / this->All->Size();
  return this->All->LargestOf(static_cast<float>(this->NodesHeld())) <= most * share;
}

/// Removes all distributions but one.
void FieldDistribution::KeepOnly(Place home)
{
  const std::size_t number = this->NumberOf(home);
  this->Of = { std::move(this->Of[number]) };
  this->Places = { home };
}

/// Makes the sweeps of all other terms transfer slabs from the only distribution.
void FieldDistribution::VisitHome(const std::vector<OfTerm>& terms)
{
  FieldLayout fields(*this->All, NodeBox::Of(this->Nodes), this->RegionsOf(0, &Regions::changed),
    this->RegionsOf(0, &Regions::needed));
  fields.room = this->Room;
  for (Place number = 0; number < terms.size(); ++number)
  {
    for (FrustumRays<HostDevice>& rays : *terms[number].frusta)
    {
      if (!this->Has(number))
      {
        rays.SweepFieldsOf(fields, this->Filled);
      }
    }
  }
}

void FieldDistribution::AddTerm(Place number, const OfTerm& term)
{
  std::vector<Regions> ofFrusta;
  for (FrustumRays<HostDevice>& rays : *term.frusta)
  {
    rays.ShareAmong(*this->All);
    Regions regions;
    for (int rank = 0; rank < this->All->Size(); ++rank)
    {
      regions.changed.push_back(OwnedRegion(rays.Plan(), rays.Bands(), rank));
      regions.needed.push_back(NeededRegion(rays.Plan(), rays.Bands(), rank));
    }
    ofFrusta.push_back(std::move(regions));
  }
  const NodeBox unswept = NodeAt(*term.source, this->Nodes);
  if (!unswept.Empty() && !ofFrusta.empty())
  {
    Regions& regions = ofFrusta.front(); // the first rank owns it
    regions.changed.front().push_back(unswept);
    regions.needed.front().push_back(unswept);
  }
  this->Places.push_back(number);
  this->Of.push_back(std::move(ofFrusta));
}

/// `more`: number of ghost slices on either side.
void FieldDistribution::AddSlabs(int more)
{
  Regions regions;
  for (const NodeBox& box : EvenSlabs(*this->All, this->Nodes))
  {
    regions.changed.push_back({ box });
    regions.needed.push_back({ box.Grown(more, this->Nodes) });
  }
  this->Places.push_back(slabs);
  this->Of.push_back({ std::move(regions) });
}

bool FieldDistribution::Has(Place place) const
{
  return std::find(this->Places.begin(), this->Places.end(), place) != this->Places.end();
}

/// Returns the index of a distribution, or 0 if only one is left.
std::size_t FieldDistribution::NumberOf(Place place) const
{
  const auto found = std::find(this->Places.begin(), this->Places.end(), place);
  return found == this->Places.end() ? 0 : static_cast<std::size_t>(found - this->Places.begin());
}

/// Returns the union of the regions over all frusta of a term.
std::vector<Region> FieldDistribution::RegionsOf(
  std::size_t place, std::vector<Region> Regions::*kind) const
{
  std::vector<Region> all(std::size_t(this->All->Size()));
  for (const Regions& frustum : this->Of[place])
  {
    Append(all, frustum.*kind);
  }
  return all;
}

FieldView FieldDistribution::Whole(const float* field) const
{
  return FieldView::Whole(const_cast<float*>(field), this->Nodes);
}

void FieldDistribution::FromPieces(
  const std::vector<Region>& pieces, const std::vector<Input>& inputs) const
{
  std::vector<Region> needed(std::size_t(this->All->Size()));
  for (std::size_t place = 0; place < this->Of.size(); ++place)
  {
    Append(needed, this->RegionsOf(place, &Regions::needed));
  }
  const ExchangePlan ways(*this->All, pieces, needed, this->Filled,
    std::make_shared<ExchangeBuffers>(), ExchangePlan::Keep::Boxes);
  for (const Input& input : inputs)
  {
    ways.Bring({ { input.piece, this->Whole(input.field) } });
  }
}

void FieldDistribution::ToPiece(const float* field, const FieldView& piece) const
{
  Spread(*this->All, this->Whole(field), this->RegionsOf(0, &Regions::changed), piece, this->Wanted,
    this->Filled);
}

void FieldDistribution::ShareFrustum(float* field, Place term, std::size_t frustum) const
{
  const std::size_t place = this->NumberOf(term);
  const std::vector<Regions>& frusta = this->Of[place];
  if (!this->Has(term) || frusta.size() == 1)
  {
    return;
  }
  this->Bring(field, { place, frustum, 0 },
    [&]
    {
      std::vector<Region> needed(std::size_t(this->All->Size()));
      for (std::size_t other = 0; other < frusta.size(); ++other)
      {
        if (other != frustum)
        {
          Append(needed, frusta[other].needed);
        }
      }
      return ExchangePlan(*this->All, frusta[frustum].changed, needed, this->Filled, this->Room);
    });
}

void FieldDistribution::Share(float* field, Place place) const
{
  const std::size_t from = this->NumberOf(place);
  const bool isSlab = this->Places[from] == slabs;
  this->Bring(field, { from, 0, 1 },
    [&]
    {
      std::vector<Region> needed(std::size_t(this->All->Size()));
      for (std::size_t other = 0; other < this->Of.size(); ++other)
      {
        if (other != from || isSlab) // for the same sweep only the other frusta matter
        {
          Append(needed, this->RegionsOf(other, &Regions::needed));
        }
      }
      return ExchangePlan(
        *this->All, this->RegionsOf(from, &Regions::changed), needed, this->Filled, this->Room);
    });
}

void FieldDistribution::Pass(float* field, Place from, Place to) const
{
  const std::size_t before = this->NumberOf(from);
  const std::size_t after = this->NumberOf(to);
  if (before == after)
  {
    return;
  }
  this->Bring(field, { before, after, 2 },
    [&]
    {
      return ExchangePlan(*this->All, this->RegionsOf(before, &Regions::changed),
        this->RegionsOf(after, &Regions::changed), this->Filled, this->Room);
    });
}

/// Performs an exchange; `find` creates its plan the first time.
template <class Find>
void FieldDistribution::Bring(float* field, const Way& way, const Find& find) const
{
  auto known = this->Known.find(way);
  if (known == this->Known.end())
  {
    known = this->Known.emplace(way, find()).first;
  }
  known->second.Bring({ { this->Whole(field), this->Whole(field) } });
}

void FieldDistribution::SetZero(Place place, float* field) const
{
  this->ForNeededHere(
    this->NumberOf(place), [&](const NodeBox& box) { FillNodes(box, 0, this->Whole(field)); });
}

void FieldDistribution::CopyUnswept(
  Place term, std::size_t frusta, bool, const float* from, float* to) const
{
  if (frusta < 2)
  {
    return;
  }
  this->ForNeededHere(this->NumberOf(term),
    [&](const NodeBox& box) { CopyNodes(box, this->Whole(from), this->Whole(to), this->Filled); });
}
}
