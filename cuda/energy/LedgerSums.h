// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_LedgerSums_h
#define limpid_energy_LedgerSums_h

#include "math/ExactSum.h"
#include "scene/Structures.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace limpid
{
/// What rays have found of each structure, one `Sum` per row of the structures.
template <class Sum>
struct OfStructures
{
  std::vector<Sum> visible;
  std::vector<Sum> kept;   ///< without attenuation
  std::vector<Sum> hidden; ///< [row][row of what hides it]; empty: not counted
  std::vector<Sum> most;

  /// `tellsHiders`: whether `hidden` is counted.
  OfStructures(std::size_t rows, bool tellsHiders)
    : visible(rows)
    , kept(rows)
    , hidden(tellsHiders ? rows * rows : 0)
    , most(rows)
  {
  }

  bool TellsHiders() const { return !this->hidden.empty(); }

  Sum& HiddenBy(StructureRow row, StructureRow by)
  {
    return this->hidden[row * this->visible.size() + by];
  }
};

/// Sums over all rays. They are exact.
using LedgerSums = OfStructures<ExactSum>;

/// Sums over some rays. Summands are rounded to multiples of a number, of which these sums are
/// exact: they do not depend on which rays are summed, and in which order.
struct SumsByStructure : OfStructures<double>
{
  /// `bound`: upper bound of all sums over all rays; summands are rounded to 2^-48 of it.
  SumsByStructure(std::size_t rows, bool tellsHiders, double bound)
    : OfStructures(rows, tellsHiders)
    , Shift(bound > 0 ? 1.5 * std::ldexp(1.0, std::ilogb(bound) + 3) : 0.0)
  {
  }

  void Add(double& sum, double summand) const { sum += (summand + this->Shift) - this->Shift; }

  void AddTo(LedgerSums& sums) const
  {
    const auto add = [](const std::vector<double>& from, std::vector<ExactSum>& to)
    {
      for (std::size_t i = 0; i < from.size(); ++i)
      {
        to[i].Add(from[i]);
      }
    };
    add(this->visible, sums.visible);
    add(this->kept, sums.kept);
    add(this->hidden, sums.hidden);
    add(this->most, sums.most);
  }

private:
  double Shift; ///< numbers that were added to it are rounded
};

/// Sums for each thread at work.
class SumsOfThreads
{
public:
  explicit SumsOfThreads(SumsByStructure empty)
    : Empty(std::move(empty))
  {
  }

  /// Calls work(sums) with sums that no other thread uses.
  template <class Work>
  void With(const Work& work)
  {
    std::unique_ptr<SumsByStructure> sums = this->Take();
    work(*sums);
    const std::lock_guard<std::mutex> lock(this->Access);
    this->Free.push_back(std::move(sums));
  }

  /// Call it when no work is going on.
  void AddTo(LedgerSums& sums) const
  {
    for (const std::unique_ptr<SumsByStructure>& some : this->Free)
    {
      some->AddTo(sums);
    }
  }

private:
  std::unique_ptr<SumsByStructure> Take()
  {
    const std::lock_guard<std::mutex> lock(this->Access);
    if (this->Free.empty())
    {
      return std::make_unique<SumsByStructure>(this->Empty);
    }
    std::unique_ptr<SumsByStructure> sums = std::move(this->Free.back());
    this->Free.pop_back();
    return sums;
  }

  SumsByStructure Empty;
  std::mutex Access;
  std::vector<std::unique_ptr<SumsByStructure>> Free;
};
}

#endif
