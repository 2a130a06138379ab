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
/// What a derivative is taken of; addresses on the device, one value per node each.
struct TermFields
{
  const float* extinction;               ///< [1/length]
  const float* importance;               ///< [0, 1]
  const float* nodeImportance = nullptr; ///< for derivatives, see NodeImportance.h [0, 1]
  const float* base = nullptr; ///< base extinction [1/length]; null: what is kept is not counted

  Kept CountsKept() const { return this->base ? Kept::Counted : Kept::Ignored; }
};

/// What the ceiling of a source follows from; addresses on the device, one value per node each.
struct CeilingFields
{
  const float* base;       ///< base extinction [1/length]
  const float* importance; ///< [0, 1]
  const float* least;      ///< lower bound of the extinction [1/length]; null: 0
  MostExtinction<float> most;

  /// Without emphasis, what is kept is all.
  Kept CountsKept() const { return this->most.emphasis > 0 ? Kept::Counted : Kept::Ignored; }
};

/// The sums of what all rays of a source have seen.
struct SumsOfSeen
{
  SumsOfRays all;
  SumsOfRays kept;
};

/**
 * One of the two visibility terms of the energy, Eq. (23) or (24): what a camera or a light sees.
 *
 * Holds the rays; the fields stay with the caller, one value per node each, in the memory of the
 * device. So does the occupancy; extinctions and importances are 0 where it is not filled. Nothing
 * waits for the device.
 */
template <class AnyDevice>
class VisibilityTerm
{
public:
  /// `ranks`: see PlanSettings. `fine`: whether Forward and FindCeiling resolve layers by FineCuts.
  VisibilityTerm(std::shared_ptr<AnyDevice> device, const Grid& grid, const Occupancy& occupancy,
    const RaySource& source, double rayDensity, const Communicator* ranks = nullptr,
    bool fine = false);

  /// What the rays see, into `sum`; null: it is summed later. Leaves the optical depths of all
  /// rays.
  void Forward(const TermFields& fields, Seen* sum);

  /// The rays of one frustum alone; what they see is summed by Sum.
  void ForwardAt(std::size_t frustum, const TermFields& fields);

  /// Forward that also finds the derivative, into `gradient` [1]. Leaves no optical depths. Only
  /// voxels that the term depends on are written, which are always the same ones.
  void Differentiate(const TermFields& fields, Derivative derivative, const GradientTarget& target,
    float* gradient, Seen* sum);

  /// The derivative of Differentiate, whose optical depths the rays have already; leaves none, and
  /// sums nothing.
  void DifferentiateSeen(
    const TermFields& fields, Derivative derivative, const GradientTarget& target, float* gradient);

  /// The most that the rays could see, into `sum`, see CeilingKernel; Seen::kept counts with an
  /// emphasis only.
  void FindCeiling(const CeilingFields& fields, Seen* sum);

  /// What the rays of all frusta have seen in their last sweep.
  void Sum(Seen* sum, Kept kept);

  /// The sums of Sum, for a launch with others.
  SumsOfSeen SumsInto(Seen* sum, Kept kept)
  {
    SumsOfSeen sums;
    sums.all = SumsOfRays(this->Rays, Kept::Ignored, &sum->all);
    if (kept == Kept::Counted)
    {
      sums.kept = SumsOfRays(this->Rays, Kept::Counted, &sum->kept);
    }
    return sums;
  }

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

  std::shared_ptr<AnyDevice> Device;
  const Occupancy* Filled;
  std::vector<FrustumRays<AnyDevice>> Rays;
  bool Fine;
  SumOnDevice<AnyDevice> Add;
};
}

#endif
