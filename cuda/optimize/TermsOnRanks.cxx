// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/TermsOnRanks.h"

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

/// The node that a source of rays is at, which is in none of its frusta; empty: none.
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

TermsOnRanks::TermsOnRanks(const Communicator& ranks, const Int3& nodes,
  const std::vector<OfTerm>& terms, const Occupancy* filled)
  : All(&ranks)
  , Filled(filled)
  , Nodes(nodes)
  , Terms(terms)
  , Of(terms.size())
{
  for (std::size_t term = 0; term < terms.size(); ++term)
  {
    for (const FrustumRays<HostDevice>& rays : *terms[term].frusta)
    {
      Regions regions;
      for (int rank = 0; rank < ranks.Size(); ++rank)
      {
        regions.changed.push_back(RegionChanged(rays.Plan(), *rays.Bands(), rank));
        regions.needed.push_back(RegionNeeded(rays.Plan(), *rays.Bands(), rank));
      }
      this->Of[term].push_back(std::move(regions));
    }
    const NodeBox unswept = NodeAt(*terms[term].source, nodes);
    if (!unswept.Empty() && !this->Of[term].empty())
    {
      Regions& regions = this->Of[term].front(); // the first rank keeps it
      regions.changed.front().push_back(unswept);
      regions.needed.front().push_back(unswept);
    }
  }
}

std::size_t TermsOnRanks::NumberOf(const Frusta& term) const
{
  const auto found = std::find_if(this->Terms.begin(), this->Terms.end(),
    [&term](const OfTerm& other) { return other.frusta == &term; });
  return static_cast<std::size_t>(found - this->Terms.begin());
}

/// Of all frusta of a term.
std::vector<Region> TermsOnRanks::RegionsOf(
  std::size_t term, std::vector<Region> Regions::*kind) const
{
  std::vector<Region> all(std::size_t(this->All->Size()));
  for (const Regions& frustum : this->Of[term])
  {
    Append(all, frustum.*kind);
  }
  return all;
}

FieldView TermsOnRanks::Whole(const float* field) const
{
  return FieldView::Whole(const_cast<float*>(field), this->Nodes);
}

void TermsOnRanks::FromPieces(
  const std::vector<Region>& pieces, const FieldView& piece, float* field) const
{
  std::vector<Region> needed(std::size_t(this->All->Size()));
  for (std::size_t term = 0; term < this->Of.size(); ++term)
  {
    Append(needed, this->RegionsOf(term, &Regions::needed));
  }
  Spread(*this->All, piece, pieces, this->Whole(field), needed, this->Filled);
}

void TermsOnRanks::ToPieces(
  const float* field, const std::vector<Region>& pieces, const FieldView& piece) const
{
  Spread(*this->All, this->Whole(field), this->RegionsOf(0, &Regions::changed), piece, pieces,
    this->Filled);
}

void TermsOnRanks::ShareFrustum(float* field, const Frusta& term, std::size_t frustum) const
{
  const std::vector<Regions>& frusta = this->Of[this->NumberOf(term)];
  if (frusta.size() == 1)
  {
    return;
  }
  std::vector<Region> needed(std::size_t(this->All->Size()));
  for (std::size_t other = 0; other < frusta.size(); ++other)
  {
    if (other != frustum)
    {
      Append(needed, frusta[other].needed);
    }
  }
  Spread(*this->All, this->Whole(field), frusta[frustum].changed, this->Whole(field), needed,
    this->Filled);
}

void TermsOnRanks::Share(float* field, const Frusta& term) const
{
  if (this->Of.size() == 1)
  {
    return;
  }
  const std::size_t from = this->NumberOf(term);
  std::vector<Region> needed(std::size_t(this->All->Size()));
  for (std::size_t other = 0; other < this->Of.size(); ++other)
  {
    if (other != from)
    {
      Append(needed, this->RegionsOf(other, &Regions::needed));
    }
  }
  Spread(*this->All, this->Whole(field), this->RegionsOf(from, &Regions::changed),
    this->Whole(field), needed, this->Filled);
}

void TermsOnRanks::Pass(float* field, const Frusta& from, const Frusta& to) const
{
  Spread(*this->All, this->Whole(field), this->RegionsOf(this->NumberOf(from), &Regions::changed),
    this->Whole(field), this->RegionsOf(this->NumberOf(to), &Regions::changed), this->Filled);
}

void TermsOnRanks::FillNeeded(const Frusta& term, float value, float* field) const
{
  const auto own = std::size_t(this->All->Rank());
  for (const Regions& frustum : this->Of[this->NumberOf(term)])
  {
    for (const NodeBox& box : frustum.needed[own])
    {
      FillNodes(box, value, this->Whole(field));
    }
  }
}

void TermsOnRanks::CopyNeeded(const Frusta& term, const float* from, float* to) const
{
  const auto own = std::size_t(this->All->Rank());
  for (const Regions& frustum : this->Of[this->NumberOf(term)])
  {
    for (const NodeBox& box : frustum.needed[own])
    {
      CopyNodes(box, this->Whole(from), this->Whole(to));
    }
  }
}
}
