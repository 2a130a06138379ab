// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_TermsOnRanks_h
#define limpid_optimize_TermsOnRanks_h

#include "sweep/FrustumRays.h"
#include "sweep/RankRegions.h"

#include <vector>

namespace limpid
{
/**
 * Where ranks have the fields of a problem that they share. Every rank has arrays of all nodes, in
 * small pages, so that only what it needs takes memory: the nodes beside its bands of every term's
 * rays. Whoever changes a field brings it to those who read it next.
 */
class TermsOnRanks
{
public:
  using Frusta = std::vector<FrustumRays<HostDevice>>;

  /// A term by its frusta, which stay where they are.
  struct OfTerm
  {
    const Frusta* frusta;
    const RaySource* source;
  };

  /// `filled`: where fields may differ from 0; null: anywhere. It has to stay.
  TermsOnRanks(const Communicator& ranks, const Int3& nodes, const std::vector<OfTerm>& terms,
    const Occupancy* filled);

  const Communicator& Ranks() const { return *this->All; }

  /// Brings a field from `pieces`, of each rank one region, to all who need any of it.
  void FromPieces(const std::vector<Region>& pieces, const FieldView& piece, float* field) const;

  /// Brings a field that everybody has back to the pieces.
  void ToPieces(
    const float* field, const std::vector<Region>& pieces, const FieldView& piece) const;

  /// Brings what the sweep of a frustum has changed to those who need it for the other frusta of
  /// the term.
  void ShareFrustum(float* field, const Frusta& term, std::size_t frustum) const;

  /// Brings what the sweeps of a term have changed to those who need it for other terms.
  void Share(float* field, const Frusta& term) const;

  /// Brings what the sweeps of a term have changed to those who change it next, for another term.
  void Pass(float* field, const Frusta& from, const Frusta& to) const;

  /// Sets what this rank needs for a term.
  void FillNeeded(const Frusta& term, float value, float* field) const;

  /// Copies what this rank needs for a term.
  void CopyNeeded(const Frusta& term, const float* from, float* to) const;

private:
  /// Of a frustum, per rank.
  struct Regions
  {
    std::vector<Region> changed;
    std::vector<Region> needed;
  };

  std::size_t NumberOf(const Frusta& term) const;
  std::vector<Region> RegionsOf(std::size_t term, std::vector<Region> Regions::*kind) const;
  FieldView Whole(const float* field) const;

  const Communicator* All;
  const Occupancy* Filled;
  Int3 Nodes;
  std::vector<OfTerm> Terms;
  std::vector<std::vector<Regions>> Of; ///< [term][frustum]
};
}

#endif
