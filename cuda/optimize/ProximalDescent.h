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
 * Keeps the energy of policy iterates from rising. An iterate that does not lower the energy F is
 * rejected, and the next sweep starts from the best iterate. If the last sweep had started there
 * already, the next one minimises
 *
 *    F(mu) + t/2 |mu - mu_last|^2
 *
 * instead, a proximal step [SS80]; the larger t, the shorter the step. Each rejection increases t,
 * and each accepted iterate decreases it, until it is 0 again.
 */
class ProximalDescent
{
public:
  /// `first`: t after the first rejection, relative to the weight of the regularisation.
  explicit ProximalDescent(double first)
    : First(first)
  {
  }

  /// Restarts from an iterate of any energy.
  void BeginAt(double energy)
  {
    this->Energy = energy;
    this->Change = std::numeric_limits<double>::infinity();
  }

  /// Returns whether an iterate of the given energy is accepted. If not, the next sweep starts
  /// from the best iterate, whose energy is `best`.
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

  /// Relative energy change of the last iterate, accepted or not.
  double EnergyChange() const { return this->Change; }

  /// t for the next sweep, relative to the weight of the regularisation.
  double Proximity() const { return this->Stiffness; }

private:
  static constexpr double rounding = 1e-6; ///< relative rounding error of an energy, summed in
                                           ///< float
  static constexpr double stiffening = 4;
  static constexpr double softening = 2;
  static constexpr double stiffest = 1e30; ///< at this value nothing moves any more

  double First;
  double Stiffness = 0;
  double Energy = 0; ///< energy of the iterate that the next sweep starts from
  double Change = 0; ///< see EnergyChange
};
}

#endif
