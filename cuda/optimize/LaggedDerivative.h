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
    this->Pulled = {};
    this->FilledBy = nullptr;
    this->Beside = nullptr;
  }

  /// One value per node; null: there are no other terms.
  const float* Data() const { return this->Sum.Data(); }

  /// Returns these values minus the pull of neighbours upon the extinction at the start of a turn.
  const float* WithPull(const Turn& turn, const float* last)
  {
    if (this->Pulled.Empty())
    {
      this->Pulled = this->Zeros("the pull");
    }
    const DistributionOn<AnyDevice>& shared = this->Energy->Distribution();
    if (!this->Sum.Empty())
    {
      shared.Pass(this->Sum.Data(), turn.swept->Number(), FieldDistribution::slabs);
    }
    FindPull(*this->Device,
      { this->Given->grid.nodes, this->Energy->Fields().base.Data(),
        this->Energy->Fields().importance.Data(), last, this->Sum.Data(),
        static_cast<float>(turn.smoothing), this->Pulled.Data() },
      this->Given->OwnSlab().slices);
    shared.Pass(this->Pulled.Data(), FieldDistribution::slabs, turn.swept->Number());
    return this->Pulled.Data();
  }

private:
  DeviceArray<AnyDevice, float> Zeros(const char* what) const
  {
    return DeviceArray<AnyDevice, float>::Zeros(
      this->Device, static_cast<std::size_t>(this->Given->grid.NodeCount()), what);
  }

  /// Makes the sum 0 where the terms of a turn do not overwrite it.
  void MakeRoom(const Turn& turn)
  {
    const bool several = turn.others.size() > 1;
    if (several && !this->Sum.Empty())
    {
      this->Energy->Distribution().SetZero(turn.others.front()->Number(), this->Sum.Data());
    }
    else if (several || this->FilledBy != turn.others[0]) // each writes voxels of its own
    {
      this->Sum = {};
      this->Sum = this->Zeros("the lagged derivative");
    }
  }

  std::shared_ptr<AnyDevice> Device;
  const Problem* Given;
  Terms<AnyDevice>* Energy;
  DeviceArray<AnyDevice, float> Sum;    ///< empty: not needed yet
  const Term* FilledBy = nullptr;       ///< the one term that has written it; null: several
  const Term* Beside = nullptr;         ///< the swept term if it is of the last iterate
  DeviceArray<AnyDevice, float> Pulled; ///< the sum less the pull; empty: not needed yet
};
}

#endif
