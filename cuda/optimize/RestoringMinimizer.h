// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_RestoringMinimizer_h
#define limpid_optimize_RestoringMinimizer_h

#include "optimize/Problem.h"

#include <memory>
#include <utility>
#include <vector>

namespace limpid
{
/// A minimiser that delegates to another one, which works on the problem in a different form.
/// Results are converted back on request.
class RestoringMinimizer : public Minimizer
{
public:
  void Use(std::unique_ptr<Minimizer> minimizer) { this->Inner = std::move(minimizer); }

  IterationRecord Start() override { return this->Inner->Start(); }

  IterationRecord Iterate() override
  {
    this->IsRestored = false;
    return this->Inner->Iterate();
  }

  IterationRecord Smooth() override
  {
    this->IsRestored = false;
    return this->Inner->Smooth();
  }

  Score BaseScore() const override { return this->Inner->BaseScore(); }
  bool Converged() const override { return this->Inner->Converged(); }
  bool IsNear() const override { return this->Inner->IsNear(); }
  int IterationLimit() const override { return this->Inner->IterationLimit(); }

  const std::vector<float>& Best() const override
  {
    if (!this->IsRestored)
    {
      this->Restore(*this->Inner, this->Restored);
      this->IsRestored = true;
    }
    return this->Restored;
  }

  void KeepOnlyBest() override { this->Inner->KeepOnlyBest(); }

  std::vector<float> TakeBest() override
  {
    this->KeepOnlyBest();
    this->Best();
    return std::move(this->Restored);
  }

private:
  /// Converts the best iterate of the inner minimiser to the form of the problem. `best`: empty,
  /// or the result of the last conversion.
  virtual void Restore(const Minimizer& inner, std::vector<float>& best) const = 0;

  std::unique_ptr<Minimizer> Inner;
  mutable std::vector<float> Restored; ///< the best iterate, converted
  mutable bool IsRestored = false;
};
}

#endif
