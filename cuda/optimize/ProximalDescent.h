// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_ProximalDescent_h
#define limpid_optimize_ProximalDescent_h

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpid
{
/**
 * Keeps the iterates of a policy from rising. An iterate that does not lower the energy F is
 * refused, and the next sweep starts from the best one again. If that is what the last sweep has
 * started from, it minimises
 *
 *   F(mu) + t/2 |mu - mu_last|^2
 *
 * instead, a proximal step [SS80], which is the shorter the larger t is. Every refusal makes t
 * larger, every iterate that is kept makes it smaller, until it is 0 again.
 */
class ProximalDescent
{
public:
  /// `first`: t after a refusal of a sweep without it, over the weight of the regularisation.
  explicit ProximalDescent(double first)
    : First(first)
  {
  }

  /// Begins from an iterate, however high its energy is.
  void BeginAt(double energy)
  {
    this->Energy = energy;
    this->Change = std::numeric_limits<double>::infinity();
  }

  /// Takes the energy of the next iterate. Returns whether it is kept; if not, the next sweep
  /// starts from the best iterate. `best`: energy of that.
  bool Keeps(double energy, double best)
  {
    this->Change = std::abs(energy - this->Energy) / std::abs(this->Energy);
    if (energy < this->Energy - rounding * std::abs(this->Energy))
    {
      this->Energy = energy;
      this->Stiffness = std::max(0.0, (1 + this->Stiffness) / softening - 1);
      return true;
    }
    if (this->Energy > best)
    {
      this->BeginAt(best);
      return false;
    }
    this->Stiffness =
      this->Stiffness > 0 ? std::min(stiffest, stiffening * this->Stiffness) : this->First;
    return false;
  }

  /// How far the last iterate, kept or not, was from the one before, as a share of its energy.
  double EnergyChange() const { return this->Change; }

  /// t for the next sweep, over the weight of the regularisation.
  double Proximity() const { return this->Stiffness; }

private:
  static constexpr double rounding = 1e-6; ///< of an energy, which is summed in float
  static constexpr double stiffening = 4;
  static constexpr double softening = 2;
  static constexpr double stiffest = 1e30; ///< where nothing moves any more

  double First;
  double Stiffness = 0;
  double Energy = 0; ///< of the iterate that the next sweep starts from
  double Change = 0; ///< see EnergyChange
};
}

#endif
