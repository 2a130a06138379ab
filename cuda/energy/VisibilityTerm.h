// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_VisibilityTerm_h
#define limpid_energy_VisibilityTerm_h

#include "energy/CeilingKernel.h"
#include "energy/Derivative.h"
#include "energy/GradientKernel.h"
#include "sweep/SumRays.h"

#include <memory>
#include <vector>

namespace limpid
{
/// The fields of a visibility term: device addresses, one value per node each.
struct TermFields
{
  const float* extinction;               ///< [1/length]
  const float* importance;               ///< [0, 1]
  const float* nodeImportance = nullptr; ///< for derivatives, see NodeImportance.h [0, 1]
  const float* base = nullptr; ///< base extinction [1/length]; null: kept part is not counted

  Kept CountsKept() const { return this->base ? Kept::Counted : Kept::Ignored; }
};

/// The fields of a ceiling: device addresses, one value per node each.
struct CeilingFields
{
  const float* base;       ///< base extinction [1/length]
  const float* importance; ///< [0, 1]
  const float* least;      ///< lower bound of the extinction [1/length]; null stands for 0
  MostExtinction<float> most;

  /// Without emphasis, all extinction is kept base extinction.
  Kept CountsKept() const { return this->most.emphasis > 0 ? Kept::Counted : Kept::Ignored; }
};

/**
 * One of the two kinds of visibility terms of the energy, Eq. (23) or (24): what a camera or a
 * light sees.
 *
 * Holds the rays. The caller owns the fields, one value per node each in device memory, and the
 * occupancy; extinctions and importances are 0 where it is not filled. All operations are
 * asynchronous.
 */
template <class AnyDevice>
class VisibilityTerm
{
public:
  /// `fine`: whether Forward and FindCeiling resolve layers by FineCuts.
  VisibilityTerm(std::shared_ptr<AnyDevice> device, const Grid& grid, const Occupancy& occupancy,
    const RaySource& source, double rayDensity, bool fine = false);

  /// Sums what the rays see into `sum`; null: it is summed later. Leaves the optical depths of all
  /// rays.
  void Forward(const TermFields& fields, Seen* sum);

  /// Forward for one frustum only; Sum adds up the results.
  void ForwardAt(std::size_t frustum, const TermFields& fields);

  /// Forward that also computes the derivative, into `gradient` [1]. Leaves no optical depths.
  /// Only voxels that the term depends on are written, the same ones each time.
  void Differentiate(const TermFields& fields, Derivative derivative, const GradientTarget& target,
    float* gradient, Seen* sum);

  /// Computes the derivative for rays that hold the optical depths already. Leaves none, and sums
  /// nothing.
  void DifferentiateSeen(
    const TermFields& fields, Derivative derivative, const GradientTarget& target, float* gradient);

  /// Sums an upper bound of what the rays can see into `sum`, see CeilingKernel. Seen::kept is
  /// counted only with emphasis.
  void FindCeiling(const CeilingFields& fields, Seen* sum);

  /// Sums what the rays of all frusta have seen in their last sweep.
  void Sum(Seen* sum, Kept kept);

  /// Returns the sums of Sum, to be computed in a launch with others.
  SumsOfSeen SumsInto(Seen* sum, Kept kept) { return { this->Rays, kept, sum }; }

  std::vector<FrustumRays<AnyDevice>>& Frusta() { return this->Rays; }
  const std::vector<FrustumRays<AnyDevice>>& Frusta() const { return this->Rays; }
  const Occupancy& Occupied() const { return *this->Filled; }

private:
  template <class Cuts>
  void Score(FrustumRays<AnyDevice>& rays, const TermFields& fields);

  template <class Cuts>
  void FindMost(FrustumRays<AnyDevice>& rays, const CeilingFields& fields);

  void SweepGradient(FrustumRays<AnyDevice>& rays, const TermFields& fields, Derivative derivative,
    const GradientTarget& target, float* gradient);

  template <Kept kept>
  void SweepGradientAs(FrustumRays<AnyDevice>& rays, const TermFields& fields,
    Derivative derivative, const GradientTarget& target, float* gradient);

  std::shared_ptr<AnyDevice> Device;
  const Occupancy* Filled;
  std::vector<FrustumRays<AnyDevice>> Rays;
  bool Fine;
  SumOnDevice<AnyDevice> Add;
};
}

#endif
