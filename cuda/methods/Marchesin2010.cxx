// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for each device, see CompiledDevice.h.

#include "methods/Marchesin2010.h"

#include "backend/CompiledDevice.h"
#include "methods/WeighedMean.h"
#include "sweep/Sweeps.h"

namespace limpid
{
namespace
{
/// Front to back: adds up optical depth and important extinction inside the box.
struct AddUpStep
{
  RayStates rays;

  template <class RayHere>
  LIMPID_HD LIMPID_INLINE void operator()(const RayHere& here, Index i) const
  {
    const TwoHalves halves = TwoHalves::Inside(here);
    this->rays[RayDepth::ToSlice][i] += halves.front.LimitedDepth() + halves.rear.LimitedDepth();
    this->rays[RayChannel::Unattenuated][i] += halves.front.unattenuated + halves.rear.unattenuated;
  }
};

/// Computes what a ray has seen at its end.
struct ShareStep
{
  RayStates rays;

  LIMPID_HD LIMPID_INLINE void operator()(Index i) const
  {
    this->rays[RayChannel::Visible][i] = this->rays[RayChannel::Unattenuated][i] *
      EqualTransmittance(static_cast<float>(this->rays[RayDepth::ToSlice][i]));
  }
};

template <class Field>
struct EqualScoreKernel
{
  static constexpr const char* label = "score in no order";

  Field extinction; ///< [1/length]
  Field importance; ///< [0, 1]

  template <class Windows>
  EqualScoreKernel<SliceWindow*> With(Windows& windows) const
  {
    return { windows(this->extinction, FieldUse{ 1 }), windows(this->importance, FieldUse{ 1 }) };
  }

  /// Calls visit for the values that rays carry.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE void ForCarried(const Visit& visit) const
  {
    ForValues(visit, RayDepth::ToSlice, RayChannel::Unattenuated);
  }

  template <class Rays>
  LIMPID_HD LIMPID_INLINE void RayStep(Rays& rays, int s) const
  {
    if (rays.EnterLayer(s, true))
    {
      rays.SampleExtinction(this->extinction);
      rays.SampleImportance(this->importance);
      rays.ForEachInLayer(AddUpStep{ rays.States() });
    }
  }
};
}

template <class AnyDevice>
Seen SeeMarchesin2010(const MethodScene<AnyDevice>& scene)
{
  // Structures behind everything important count, too, so nothing is skipped.
  const Occupancy everywhere(scene.grid, scene.base, scene.importance, false);
  std::vector<FrustumRays<AnyDevice>> all =
    PlanRays(scene.device, scene.grid, everywhere, scene.source, { scene.rayDensity });
  for (FrustumRays<AnyDevice>& rays : all)
  {
    SweepForward(*scene.device, rays, everywhere,
      EqualScoreKernel<const float*>{ scene.base, scene.importance });
    scene.device->ForIndices(
      "score in no order", rays.Plan().RayCount(), ShareStep{ rays.States() });
  }
  Seen seen;
  ResultArray<AnyDevice, Seen> there(scene.device, &seen, 1, "sums");
  SumOnDevice<AnyDevice> add(scene.device);
  SumRays(add, all, Kept::Ignored, there.Data());
  there.Download();
  return { seen.all, seen.all }; // all of the base is kept
}

template Seen SeeMarchesin2010(const MethodScene<CompiledDevice>&);
}
