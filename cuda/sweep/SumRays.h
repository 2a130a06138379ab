// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Integrals over the domain, from what the rays have added up along their way.

#ifndef limpid_sweep_SumRays_h
#define limpid_sweep_SumRays_h

#include "backend/Backend.h"
#include "backend/SumOnDevice.h"
#include "sweep/FrustumRays.h"

#include <numeric>
#include <type_traits>
#include <vector>

namespace limpid
{
/// Integrals over the domain of importance times extinction, with and without transmittance.
struct Visible
{
  double visible = 0;      ///< S of Eq. (32) [length^2]
  double unattenuated = 0; ///< its upper bound [length^2]

  Visible& operator+=(const Visible& other)
  {
    this->visible += other.visible;
    this->unattenuated += other.unattenuated;
    return *this;
  }
};

/// What a source sees: of the whole extinction, and of what it keeps of the base extinction.
struct Seen
{
  Visible all;
  Visible kept; ///< 0 where it is not counted

  Seen& operator+=(const Seen& other)
  {
    this->all += other.all;
    this->kept += other.kept;
    return *this;
  }
};

/// Sum of one value per ray, for an integral over the domain of what these are integrals of along
/// their rays times scale^2; in a fixed order. `values`: per ray.
double SumOfRays(const FaceFrustum& frustum, const float* values);

namespace detail
{
/// What a ray of one of several frusta adds to an integral over the domain.
struct WeightedRay
{
  struct Part
  {
    FaceFrustum frustum;
    const float* values;
    Index first; ///< number of its first ray among those of all frusta
  };

  static constexpr int mostParts = 6;
  Part parts[mostParts];
  int count = 0;

  LIMPID_HD LIMPID_INLINE double operator()(Index number) const
  {
    int at = this->count - 1;
    while (number < this->parts[at].first)
    {
      --at;
    }
    const Part& part = this->parts[at];
    const FaceFrustum& frustum = part.frustum;
    const Index ray = number - part.first;
    const double shareU = frustum.Row(frustum.columnShare)[ray % frustum.columns];
    const double shareV = frustum.Row(frustum.rowShare)[ray / frustum.columns];
    const double share = frustum.cellMeasure * shareU * shareV;
    // What a guard carries may be no number.
    return share > 0 ? share / double(frustum.Row(frustum.length)[ray]) * part.values[ray] : 0.0;
  }
};
}

/// The same on a device, for the host: waits.
template <class AnyDevice>
double SumOfRays(
  const std::shared_ptr<AnyDevice>& device, const FaceFrustum& frustum, const float* values)
{
  if constexpr (std::is_same_v<AnyDevice, HostDevice>)
  {
    return SumOfRays(frustum, values);
  }
  else
  {
    detail::WeightedRay rays;
    rays.parts[rays.count++] = { frustum, values, 0 };
    SumOnDevice<AnyDevice> add(device);
    DeviceArray<AnyDevice, double> there(device, 1, "sums");
    add("sum of rays", frustum.RayCount(), rays, there.Data());
    double sum = 0;
    there.Download(&sum);
    return sum;
  }
}

/// Of a ray: what it has seen of everything, or of what is kept (Kept::Counted).
struct SeenByRay
{
  const float* visible;
  const float* unattenuated;

  SeenByRay(const RayStates& rays, Kept kept)
    : visible(kept == Kept::Counted ? rays.keptVisible : rays.visible)
    , unattenuated(kept == Kept::Counted ? rays.keptUnattenuated : rays.unattenuated)
  {
  }
};

/// What all rays have seen, into `sum` on the device. Does not wait.
template <class AnyDevice>
void SumRays(std::vector<FrustumRays<AnyDevice>>& frusta, Kept kept, SumOnDevice<AnyDevice>& add,
  Visible* sum, std::size_t)
{
  detail::WeightedRay visible;
  detail::WeightedRay unattenuated;
  Index count = 0;
  for (FrustumRays<AnyDevice>& frustum : frusta)
  {
    const SeenByRay seen(frustum.States(), kept);
    visible.parts[visible.count++] = { frustum.Plan(), seen.visible, count };
    unattenuated.parts[unattenuated.count++] = { frustum.Plan(), seen.unattenuated, count };
    count += frustum.Plan().RayCount();
  }
  add("sum of rays", count, visible, &sum->visible);
  add("sum of rays", count, unattenuated, &sum->unattenuated);
}

/// The processor sums row by row, and the frusta in cyclic order from `first`.
inline void SumRays(std::vector<FrustumRays<HostDevice>>& frusta, Kept kept,
  SumOnDevice<HostDevice>&, Visible* sum, std::size_t first)
{
  *sum = {};
  for (std::size_t i = 0; i < frusta.size(); ++i)
  {
    FrustumRays<HostDevice>& frustum = frusta[(first + i) % frusta.size()];
    const SeenByRay seen(frustum.States(), kept);
    *sum +=
      { SumOfRays(frustum.Plan(), seen.visible), SumOfRays(frustum.Plan(), seen.unattenuated) };
  }
}
}

#endif
