// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_FieldDistribution_h
#define limpid_optimize_FieldDistribution_h

#include "distributed/ExchangePlan.h"
#include "distributed/ScenePiece.h"
#include "scene/FieldView.h"
#include "sweep/FrustumRays.h"

#include <array>
#include <map>
#include <vector>

namespace limpid
{
/**
 * The distribution of the fields of a problem among ranks. Every rank has arrays of all nodes in
 * small pages, so that only the nodes it needs take memory: those next to its rays of every term
 * and, for work without rays, its slab. After a field has changed, its values are redistributed to
 * the ranks that read it next.
 *
 * If this takes much more than an even share of the memory, there is only one distribution, and
 * the sweeps of other terms transfer slabs from it (SlabExchange): that of the first term or, if
 * that needs as much or if some work needs no rays, slabs.
 */
class FieldDistribution
{
public:
  using Frusta = std::vector<FrustumRays<HostDevice>>;

  /// A distribution in which fields are changed: next to the rays of a term, given by its frusta,
  /// whose address must not change, or slabs with one ghost slice on either side.
  using Place = const Frusta*;
  static constexpr Place slabs = nullptr;

  /// A term and the source of its rays.
  struct OfTerm
  {
    Frusta* frusta;
    const RaySource* source;
  };

  /// `filled`: where fields may differ from 0; it must outlive this object. `inSlabs`: whether
  /// some work is done in slabs.
  FieldDistribution(const Communicator& ranks, const Int3& nodes, const std::vector<OfTerm>& terms,
    const Occupancy& filled, bool inSlabs, FieldPlaces places);

  const Communicator& Ranks() const { return *this->All; }

  /// Number of nodes of a field for which this rank holds memory: all nodes on pages that it
  /// needs.
  Index NodesHeld() const;

  /// A field in this rank's subdomain, and an array of all nodes for the values that it needs.
  struct Input
  {
    FieldView piece;
    float* field;
  };

  /// Redistributes fields from `pieces`, one region per rank, to all ranks that need them.
  void FromPieces(const std::vector<Region>& pieces, const std::vector<Input>& inputs) const;

  /// Redistributes a field that is valid in all distributions back to the pieces.
  void ToPieces(
    const float* field, const std::vector<Region>& pieces, const FieldView& piece) const;

  /// Redistributes the changes of the sweep of one frustum for the other frusta of the term.
  void ShareFrustum(float* field, Place term, std::size_t frustum) const;

  /// Redistributes values changed in one distribution to all others, and to its ghost nodes.
  void Share(float* field, Place place) const;

  /// Redistributes updated values between two distributions.
  void Pass(float* field, Place from, Place to) const;

  /// Sets the values that this rank needs in a distribution.
  void FillNeeded(Place place, float value, float* field) const;

  /// Copies the values that this rank needs in a distribution.
  void CopyNeeded(Place place, const float* from, float* to) const;

private:
  /// The regions of a frustum, or of the slabs, per rank.
  struct Regions
  {
    std::vector<Region> changed;
    std::vector<Region> needed;
  };

  /// Identifies an exchange by source, target and purpose; its plan is the same each time.
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
  std::shared_ptr<ExchangeBuffers> Room = std::make_shared<ExchangeBuffers>();
  mutable std::map<Way, ExchangePlan> Known;
};
}

#endif
