// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_TermsOnRanks_h
#define limpid_optimize_TermsOnRanks_h

#include "scene/ScenePiece.h"
#include "sweep/FrustumRays.h"
#include "sweep/RankRegions.h"

#include <array>
#include <map>
#include <vector>

namespace limpid
{
/**
 * Where ranks have the fields of a problem that they share. Every rank has arrays of all nodes, in
 * small pages, so that only what it needs takes memory: the nodes beside its bands of every term's
 * rays and, if work needs no rays, its slab. Whoever changes a field brings it to those who read it
 * next. Where that takes much more than a share of the memory, there is one place alone, and the
 * sweeps of terms that have none visit it (SlabDelivery): beside the rays of the first term or, if
 * that takes as much or work needs no rays, in slabs.
 */
class TermsOnRanks
{
public:
  using Frusta = std::vector<FrustumRays<HostDevice>>;

  /// Where fields are changed: beside the rays of a term, by its frusta, which stay where they are,
  /// or in slabs, which need a slice more on either side.
  using Place = const Frusta*;
  static constexpr Place slabs = nullptr;

  /// A term, and its rays' source.
  struct OfTerm
  {
    Frusta* frusta;
    const RaySource* source;
  };

  /// `filled`: where fields may differ from 0. It has to stay. `inSlabs`: whether there is work in
  /// slabs, too.
  TermsOnRanks(const Communicator& ranks, const Int3& nodes, const std::vector<OfTerm>& terms,
    const Occupancy& filled, bool inSlabs, FieldPlaces places);

  const Communicator& Ranks() const { return *this->All; }

  /// Nodes of a field that this rank has memory for: those on pages with any that it needs.
  Index NodesHeld() const;

  /// A field of this rank's piece, and where what it needs of all comes to.
  struct Input
  {
    FieldView piece;
    float* field;
  };

  /// Brings fields from `pieces`, of each rank one region, to all who need any of them.
  void FromPieces(const std::vector<Region>& pieces, const std::vector<Input>& inputs) const;

  /// Brings a field that everybody has back to the pieces.
  void ToPieces(
    const float* field, const std::vector<Region>& pieces, const FieldView& piece) const;

  /// Brings what the sweep of a frustum has changed to those who need it for the other frusta of
  /// the term.
  void ShareFrustum(float* field, Place term, std::size_t frustum) const;

  /// Brings what was changed in a place to those who need it in others, or beside their slabs.
  void Share(float* field, Place place) const;

  /// Brings what was changed in a place to those who change it next, in another.
  void Pass(float* field, Place from, Place to) const;

  /// Sets what this rank needs in a place.
  void FillNeeded(Place place, float value, float* field) const;

  /// Copies what this rank needs in a place.
  void CopyNeeded(Place place, const float* from, float* to) const;

private:
  /// Of a frustum or of the slabs, per rank.
  struct Regions
  {
    std::vector<Region> changed;
    std::vector<Region> needed;
  };

  /// From where to where, and for what: what passes is the same each time.
  using Way = std::array<std::size_t, 3>;

  template <class Find>
  void Bring(float* field, const Way& way, const Find& find) const;
  void AddTerm(const OfTerm& term);
  void AddSlabs(int more);
  bool HoldLittleMoreThanAShare() const;
  void KeepOnly(Place home);
  void VisitHome(const std::vector<OfTerm>& terms);
  bool Has(Place place) const;
  std::size_t NumberOf(Place place) const;
  std::vector<Region> RegionsOf(std::size_t place, std::vector<Region> Regions::*kind) const;
  FieldView Whole(const float* field) const;

  const Communicator* All;
  const Occupancy* Filled;
  Int3 Nodes;
  std::vector<Place> Places;
  std::vector<std::vector<Regions>> Of; ///< [place][frustum]
  std::shared_ptr<PassageRoom> Room = std::make_shared<PassageRoom>();
  mutable std::map<Way, Passages> Known;
};
}

#endif
