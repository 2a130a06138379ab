// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_PolicyIterates_h
#define limpid_optimize_PolicyIterates_h

#include "optimize/Iterate.h"

#include <array>
#include <cstddef>
#include <memory>
#include <utility>

namespace limpid
{
/**
 * The iterates of the policy method: the last one, the best one, and the one at which a descent
 * branched off. They share memory where they are the same.
 */
template <class AnyDevice>
class PolicyIterates
{
public:
  using Slot = std::size_t; ///< place of an iterate

  /// Starts from the base extinction. `count`: number of nodes.
  PolicyIterates(std::shared_ptr<AnyDevice> device, std::size_t count, const float* base)
    : Device(std::move(device))
    , Count(count)
    , Base(base)
  {
    this->PutBase(0);
  }

  // One value per node [1/length]:
  const float* Last() const { return this->All[this->Now].values; }
  const float* Best() const { return this->All[this->BestOf].values; }
  const float* In(Slot slot) const { return this->All[slot].values; }

  bool IsAtBest() const { return this->Now == this->BestOf; }

  /// Whether the last iterate is the base extinction itself.
  bool IsAtBase() const { return this->All[this->Now].own.Empty(); }

  /// Returns a slot for another iterate, which overwrites none that is needed.
  Slot Free() const
  {
    Slot free = 0;
    while (this->IsNeeded(free) || free == this->Now)
    {
      ++free;
    }
    return free;
  }

  /// Returns the slot that a step may write: that of the last iterate, unless it is needed.
  Slot FreeOrLast() const
  {
    return this->IsNeeded(this->Now) || this->IsAtBase() ? this->Free() : this->Now;
  }

  /// Makes a slot writable. Returns whether its values are new; they are 0 then.
  bool Allocate(Slot slot) { return AllocateIterate(this->Device, this->Count, this->All[slot]); }

  /// Values of a slot that is writable [1/length].
  float* Writable(Slot slot) { return this->All[slot].own.Data(); }

  void PutBase(Slot slot) { this->All[slot] = { {}, this->Base }; }

  void Put(Slot slot, DeviceArray<AnyDevice, float>&& values)
  {
    this->All[slot].own = std::move(values);
    this->All[slot].values = this->All[slot].own.Data();
  }

  /// Sets the record of the first iterate.
  void Begin(const IterationRecord& first)
  {
    this->Lowest = first;
    this->First = this->Latest = first.energy.Total();
  }

  /// The last iterate is the one in a slot from now on.
  void MoveTo(Slot slot, const IterationRecord& record)
  {
    this->Now = slot;
    this->Latest = record.energy.Total();
    this->Moved = record.meanChange;
  }

  /// An iterate becomes the best one if its energy is the lowest.
  void KeepIfLowest(Slot slot, const IterationRecord& record)
  {
    if (record.energy.Total() < this->LowestEnergy())
    {
      this->Lowest = record;
      this->BestOf = slot;
    }
  }

  void KeepLastIfLowest(const IterationRecord& record) { this->KeepIfLowest(this->Now, record); }

  /// The last iterate becomes the best one, whatever its energy.
  void KeepLast() { this->BestOf = this->Now; }

  /// The best iterate becomes the last one.
  void GoBack()
  {
    this->Now = this->BestOf;
    this->Latest = this->LowestEnergy();
  }

  /// A descent branches off at another iterate, which becomes the last one. `energy`: its energy.
  void Branch(Slot slot, double energy)
  {
    this->Branched = { this->Now, this->Latest, this->Moved };
    this->Now = slot;
    this->Latest = energy;
  }

  /// The last iterate is again the one before Branch.
  void EndBranch()
  {
    this->Now = this->Branched.slot;
    this->Latest = this->Branched.energy;
    this->Moved = this->Branched.change;
    this->Branched = {};
  }

  Slot LastSlot() const { return this->Now; }
  Slot BestSlot() const { return this->BestOf; }

  double FirstEnergy() const { return this->First; }
  double LastEnergy() const { return this->Latest; }
  double LowestEnergy() const { return this->Lowest.energy.Total(); }

  /// Mean change by the last step [majorant].
  double Change() const { return this->Moved; }

  /// Returns the record of the best iterate, with the last change.
  IterationRecord BestRecord() const
  {
    IterationRecord record = this->Lowest;
    record.meanChange = this->Moved;
    return record;
  }

  void FreeAllButLastAndBest() { this->FreeAllBut(this->Now, this->BestOf); }
  void FreeAllButBest() { this->FreeAllBut(this->BestOf, this->BestOf); }

  /// Moves the best iterate out; empty if it is the base extinction.
  DeviceArray<AnyDevice, float> TakeBest() { return std::move(this->All[this->BestOf].own); }

private:
  static constexpr auto none = Slot(-1);

  /// The last iterate, while a descent has another one.
  struct Place
  {
    Slot slot = none;
    double energy = 0;
    double change = 0;
  };

  bool IsNeeded(Slot slot) const { return slot == this->BestOf || slot == this->Branched.slot; }

  void FreeAllBut(Slot one, Slot other)
  {
    for (Slot slot = 0; slot < this->All.size(); ++slot)
    {
      if (slot != one && slot != other)
      {
        this->All[slot] = {};
      }
    }
  }

  std::shared_ptr<AnyDevice> Device;
  std::size_t Count;
  const float* Base;
  std::array<Iterate<AnyDevice>, 4> All; ///< filled as needed
  Slot Now = 0;                          ///< of the last iterate
  Slot BestOf = 0;
  Place Branched;
  IterationRecord Lowest; ///< record of the best iterate
  double First = 0;       ///< energy of the first iterate
  double Latest = 0;      ///< energy of the last iterate
  double Moved = 0;       ///< see Change
};
}

#endif
