// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_PolicyIterations_h
#define limpid_optimize_PolicyIterations_h

#include "optimize/Problem.h"

#include <array>
#include <utility>
#include <vector>

namespace limpid
{
/**
 * The iterations of the policy method, whatever computes them.
 *
 * An engine has a type Field, an extinction at all nodes that can be moved, and
 *
 *   void Prepare(Field& next, const Field& last);
 *       makes sure that it can be overwritten; where sweeps do not come, and for rays of a frustum
 *       that meet voxels of one that is swept later, it gets the values of the last iterate
 *   IterationRecord Start(const Field& first);
 *   IterationRecord Sweep(const Field& last, Field& next, bool trust, bool again);
 *       one policy sweep and what it leads to; `trust`: in the transmittance of the last iterate;
 *       `again`: whether another one is to be expected, which the engine may prepare
 *   const float* Values(const Field&);                                on the host
 *   const std::vector<float>& Read(const Field&);                     likewise
 *   std::vector<float> Take(Field&&);                                 likewise, given away
 *   const Problem& Task();
 */
template <class Engine>
class PolicyIterations : public Minimizer
{
public:
  using Field = typename Engine::Field;

  /// `start`: first iterate [1/length]; `warm`: its transmittance can be trusted.
  PolicyIterations(Engine&& engine, Field&& start, bool warm)
    : Computer(std::move(engine))
    , Warm(warm)
  {
    this->Iterates[0] = std::move(start);
  }

  IterationRecord Start() override
  {
    const IterationRecord record = this->Computer.Start(this->Iterates[0]);
    this->BestEnergy = record.energy.Total();
    return record;
  }

  IterationRecord Iterate() override
  {
    const std::size_t last = this->Now;
    const std::size_t next = this->FreeIterate();
    const bool trust = this->Warm || this->Count > 0;
    ++this->Count;
    const bool again = this->Count < this->IterationLimit();
    const IterationRecord record =
      this->Computer.Sweep(this->Iterates[last], this->Iterates[next], trust, again);
    this->Now = next;
    this->Change = record.meanChange;
    if (record.energy.Total() < this->BestEnergy)
    {
      this->BestEnergy = record.energy.Total();
      this->BestOf = next;
    }
    return record;
  }

  bool Converged() const override
  {
    return this->Count > 0 && this->Change < this->Computer.Task().settings.tolerance;
  }

  int IterationLimit() const override { return this->Computer.Task().settings.maximumIterations; }

  const float* BestValues() const override
  {
    return this->Computer.Values(this->Iterates[this->BestOf]);
  }

  const std::vector<float>& Best() const override
  {
    return this->Computer.Read(this->Iterates[this->BestOf]);
  }

  std::vector<float> TakeBest() override
  {
    return this->Computer.Take(std::move(this->Iterates[this->BestOf]));
  }

private:
  /// A place for the next iterate that overwrites neither the last nor the best.
  std::size_t FreeIterate()
  {
    std::size_t free = 0;
    while (free == this->Now || free == this->BestOf)
    {
      ++free;
    }
    this->Computer.Prepare(this->Iterates[free], this->Iterates[this->Now]);
    return free;
  }

  Engine Computer;
  bool Warm;
  int Count = 0;
  double Change = 0;
  double BestEnergy = 0;
  std::array<Field, 3> Iterates; ///< filled as needed
  std::size_t Now = 0;           ///< the last iterate
  std::size_t BestOf = 0;        ///< the best
};
}

#endif
