// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_LaggedDerivative_h
#define limpid_optimize_LaggedDerivative_h

#include "optimize/PolicyTurns.h"
#include "optimize/Smoothing.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace limpid
{
/// The terms whose rays have the optical depths of the last iterate. Sweeps that see it again can
/// do without a sweep from the front.
template <class AnyDevice>
class TermsThatSee
{
public:
  using Term = EnergyTerm<AnyDevice>;

  void Clear() { this->All.clear(); }
  void Add(const Term& term) { this->All.push_back(&term); }
  bool Contains(const Term& term) const
  {
    return std::find(this->All.begin(), this->All.end(), &term) != this->All.end();
  }
  void KeepOnly(const Term& term)
  {
    const bool kept = this->Contains(term);
    this->All.assign(kept ? 1 : 0, &term);
  }

private:
  std::vector<const Term*> All;
};

/**
 * What acts on the voxels of a policy sweep beside the swept term: the sum of the derivatives of
 * all other terms by an iterate (they lag behind the sweep), and the pull of neighbours.
 */
template <class AnyDevice>
class LaggedDerivative
{
public:
  using Term = EnergyTerm<AnyDevice>;
  using Turn = PolicyTurn<AnyDevice>;

  /// Problem and terms must outlive it.
  LaggedDerivative(
    std::shared_ptr<AnyDevice> device, const Problem& problem, Terms<AnyDevice>& energy)
    : Device(std::move(device))
    , Given(&problem)
    , Energy(&energy)
  {
  }

  /// Sums the derivatives of the terms that a turn does not sweep. `seeing`: the terms that have
  /// seen the extinction; those whose derivative is found lose their optical depths.
  void Find(const Turn& turn, const float* extinction, TermsThatSee<AnyDevice>& seeing)
  {
    if (turn.others.empty())
    {
      return;
    }
    const bool several = turn.others.size() > 1;
    this->MakeRoom(turn);
    const DistributionOn<AnyDevice>& shared = this->Energy->Distribution();
    std::size_t place = turn.others.front()->Number();
    for (Term* other : turn.others)
    {
      shared.Pass(this->Sum.Data(), std::exchange(place, other->Number()), other->Number());
      const float kept = several ? 1 : 0;
      seeing.Contains(*other)
        ? this->Energy->DifferentiateSeen(*other, extinction, kept, this->Sum.Data())
        : this->Energy->DifferentiateTerm(*other, extinction, kept, this->Sum.Data());
    }
    shared.Pass(this->Sum.Data(), place, turn.swept->Number());
    seeing.KeepOnly(*turn.swept);
    this->FilledBy = several ? nullptr : turn.others[0];
    this->Beside = turn.swept;
  }

  /// Whether it is the derivative by the last iterate beside a swept term.
  bool IsBeside(const Term& term) const { return this->Beside == &term; }

  /// The last iterate is another one.
  void Outdate() { this->Beside = nullptr; }

  /// Frees its memory.
  void Clear()
  {
    this->Sum = {};
    this->FilledBy = nullptr;
    this->Beside = nullptr;
  }

  /// One value per node; null: the turn sweeps all terms.
  const float* DataFor(const Turn& turn) const
  {
    return turn.others.empty() ? nullptr : this->Sum.Data();
  }

  /// Returns these values minus the pull of neighbours upon the extinction at the start of a turn,
  /// in their place.
  const float* WithPull(const Turn& turn, const float* last)
  {
    const DistributionOn<AnyDevice>& shared = this->Energy->Distribution();
    const float* lagged = this->DataFor(turn);
    if (lagged)
    {
      shared.Pass(this->Sum.Data(), turn.swept->Number(), FieldDistribution::slabs);
    }
    else if (this->Sum.Empty())
    {
      this->Sum = this->Zeros("the pull");
    }
    FindPull(*this->Device,
      { this->Given->grid.nodes, this->Energy->Fields().base.Data(),
        this->Energy->Fields().importance.Data(), last, lagged, static_cast<float>(turn.smoothing),
        this->Sum.Data() },
      this->Given->OwnSlab().slices);
    shared.Pass(this->Sum.Data(), FieldDistribution::slabs, turn.swept->Number());
    this->FilledBy = nullptr;
    this->Beside = nullptr;
    return this->Sum.Data();
  }

private:
  DeviceArray<AnyDevice, float> Zeros(const char* what) const
  {
    return DeviceArray<AnyDevice, float>::Zeros(
      this->Device, static_cast<std::size_t>(this->Given->grid.NodeCount()), what);
  }

  /// Makes the sum 0 where the terms of a turn do not overwrite it. Memory that was written in few
  /// places is exchanged, since zeros of the system take none.
  void MakeRoom(const Turn& turn)
  {
    const Term* only = turn.others.size() == 1 ? turn.others[0] : nullptr;
    if (!this->Sum.Empty() && !this->FilledBy)
    {
      this->Energy->Distribution().SetZero(turn.others.front()->Number(), this->Sum.Data());
    }
    else if (this->Sum.Empty() || this->FilledBy != only) // each writes voxels of its own
    {
      this->Sum = {};
      this->Sum = this->Zeros("the lagged derivative");
    }
  }

  std::shared_ptr<AnyDevice> Device;
  const Problem* Given;
  Terms<AnyDevice>* Energy;
  DeviceArray<AnyDevice, float> Sum; ///< empty: not needed yet
  const Term* FilledBy = nullptr; ///< the one term that has written it; null: others, or the pull
  const Term* Beside = nullptr;   ///< the swept term if it is of the last iterate
};
}

#endif
