// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_FieldDistribution_h
#define limpid_optimize_FieldDistribution_h

#include "distributed/ExchangePlan.h"
#include "distributed/ScenePiece.h"
#include "optimize/Problem.h"
#include "scene/FieldView.h"
#include "sweep/FrustumRays.h"

#include <array>
#include <map>
#include <memory>
#include <utility>
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
 * the sweeps of other terms transfer slabs from it (FieldSlabs): that of the first term or, if
 * that needs as much or if some work needs no rays, slabs. A process alone has one slab, and
 * nothing is redistributed.
 */
class FieldDistribution
{
public:
  using Frusta = std::vector<FrustumRays<HostDevice>>;

  /// A distribution in which fields are changed: next to the rays of a term, given by its number,
  /// or slabs with one ghost slice on either side.
  using Place = std::size_t;
  static constexpr Place slabs = Place(-1);

  /// A term and the source of its rays. The address of the frusta must not change.
  struct OfTerm
  {
    Frusta* frusta;
    const RaySource* source;
  };

  /// `filled`: where fields may differ from 0; it must outlive this object. `inSlabs`: whether
  /// some work is done in slabs.
  FieldDistribution(const Communicator& ranks, const Int3& nodes, const std::vector<OfTerm>& terms,
    const Occupancy& filled, bool inSlabs, FieldPlaces places);

  /// Distributes the fields of a problem, which must outlive this object.
  FieldDistribution(const Problem& problem, const std::vector<OfTerm>& terms);

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

  /// Redistributes a field that is valid in all distributions to the subdomain of a result.
  void ToPiece(const float* field, const FieldView& piece) const;

  /// Redistributes the changes of the sweep of one frustum for the other frusta of the term.
  void ShareFrustum(float* field, Place term, std::size_t frustum) const;

  /// Redistributes values changed in one distribution to all others, and to its ghost nodes.
  void Share(float* field, Place place) const;

  /// Redistributes updated values between two distributions.
  void Pass(float* field, Place from, Place to) const;

  /// Sets the values that this rank needs in a distribution to 0.
  void SetZero(Place place, float* field) const;

  /// Copies the values that the sweep of a term with several frusta reads before it writes them.
  /// `isNew`: whether `to` is 0 everywhere, which it stays where nothing is filled.
  void CopyUnswept(Place term, std::size_t frusta, bool isNew, const float* from, float* to) const;

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
  void AddTerm(Place number, const OfTerm& term);
  void AddSlabs(int more);
  bool HoldLittleMoreThanAShare() const;
  void KeepOnly(Place home);
  void VisitHome(const std::vector<OfTerm>& terms);
  bool Has(Place place) const;
  std::size_t NumberOf(Place place) const;
  std::vector<Region> RegionsOf(std::size_t place, std::vector<Region> Regions::*kind) const;
  template <class What>
  void ForNeededHere(std::size_t place, const What& what) const;
  FieldView Whole(const float* field) const;

  const Communicator* All;
  const Occupancy* Filled;
  Int3 Nodes;
  std::vector<Region> Wanted; ///< of results
  std::vector<Place> Places;
  std::vector<std::vector<Regions>> Of; ///< [place][frustum]
  std::shared_ptr<ExchangeBuffers> Room = std::make_shared<ExchangeBuffers>();
  mutable std::map<Way, ExchangePlan> Known;
};

/// The distribution of the fields on a device: a GPU holds all of them, and nothing is
/// redistributed.
template <class AnyDevice>
class DistributionOn
{
public:
  using Place = FieldDistribution::Place;

  template <class AllTerms>
  DistributionOn(std::shared_ptr<AnyDevice> device, const Problem& problem, AllTerms&)
    : Device(std::move(device))
    , Bytes(static_cast<std::size_t>(problem.grid.NodeCount()) * sizeof(float))
  {
  }

  void ToPiece(const float*, const FieldView&) const {}
  void ShareFrustum(float*, Place, std::size_t) const {}
  void Share(float*, Place) const {}
  void Pass(float*, Place, Place) const {}
  void SetZero(Place, float* field) const { this->Device->SetZero(field, this->Bytes); }
  void CopyUnswept(Place, std::size_t frusta, bool isNew, const float* from, float* to) const
  {
    if (isNew || frusta > 1)
    {
      this->Device->Copy(to, from, this->Bytes);
    }
  }

private:
  std::shared_ptr<AnyDevice> Device;
  std::size_t Bytes;
};

template <>
class DistributionOn<HostDevice> : public FieldDistribution
{
public:
  /// `terms`: the visibility terms, at fixed addresses.
  template <class AllTerms>
  DistributionOn(const std::shared_ptr<HostDevice>&, const Problem& problem, AllTerms& terms)
    : FieldDistribution(problem, RaysOf(terms))
  {
  }

private:
  template <class AllTerms>
  static std::vector<OfTerm> RaysOf(AllTerms& terms)
  {
    std::vector<OfTerm> rays;
    rays.reserve(terms.size());
    for (auto& term : terms)
    {
      rays.push_back({ &term.Frusta(), &term.Rays() });
    }
    return rays;
  }
};
}

#endif
