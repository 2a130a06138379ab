// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Integrals over the domain, computed from the values that rays have accumulated.

#ifndef limpid_sweep_SumRays_h
#define limpid_sweep_SumRays_h

#include "backend/SumOnDevice.h"
#include "math/ExactSum.h"
#include "sweep/FrustumRays.h"
#include "sweep/RaySteps.h"

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

/// Visibility from a source: of the whole extinction, and of the kept base extinction.
struct Seen
{
  Visible all;
  Visible kept; ///< 0 if it is not counted

  Seen& operator+=(const Seen& other)
  {
    this->all += other.all;
    this->kept += other.kept;
    return *this;
  }
};

/// Adds one value per ray to `sum`, row by row and exactly. A value is an integral along its ray,
/// times scale^2; cellMeasure times the sum is then the integral over the domain. `rows`: rows of
/// rays.
void AddRays(
  const FaceFrustum& frustum, const Range<int>& rows, const float* values, ExactSum& sum);

namespace detail
{
/// A summand: the contribution of the rays of several frusta to an integral over the domain.
struct WeightedRays
{
  struct Part
  {
    const float* columnShare; ///< see FaceFrustum
    const float* rowShare;
    const float* length;
    const float* values;
    double cellMeasure;
    Index first; ///< number of rays in the frusta before it
    int columns;
  };

  static constexpr int mostParts = 6;
  Part parts[mostParts];
  int count = 0;

  /// Adds the rays of a frustum; `first`: number of rays in the frusta before it.
  void Add(const FaceFrustum& frustum, const float* values, Index first)
  {
    this->parts[this->count++] = { frustum.Row(frustum.columnShare), frustum.Row(frustum.rowShare),
      frustum.Row(frustum.length), values, frustum.cellMeasure, first, frustum.columns };
  }

  LIMPID_HD LIMPID_INLINE double operator()(Index number) const
  {
    int at = this->count - 1;
    while (number < this->parts[at].first)
    {
      --at;
    }
    const Part& part = this->parts[at];
    const Index ray = number - part.first;
    const double shareU = part.columnShare[ray % part.columns];
    const double shareV = part.rowShare[ray / part.columns];
    const double share = part.cellMeasure * shareU * shareV;
    // Values of guard rays may be NaN.
    return share > 0 ? share / double(part.length[ray]) * part.values[ray] : 0.0;
  }
};
}

/// The accumulated values of rays: of the whole extinction, or of the kept base extinction.
struct SeenByRay
{
  const float* visible;
  const float* unattenuated;

  SeenByRay(const RayStates& rays, Kept kept)
    : visible(kept == Kept::Counted ? rays[RayChannel::KeptVisible] : rays[RayChannel::Visible])
    , unattenuated(
        kept == Kept::Counted ? rays[RayChannel::KeptUnattenuated] : rays[RayChannel::Unattenuated])
  {
  }
};

/// The summands for what all rays have seen.
struct SumsOfRays
{
  Summand<detail::WeightedRays> visible{ {}, 0, nullptr };
  Summand<detail::WeightedRays> unattenuated{ {}, 0, nullptr };

  /// Empty sums.
  SumsOfRays() = default;

  /// The results are written to `sum` on the device.
  template <class AnyDevice>
  SumsOfRays(std::vector<FrustumRays<AnyDevice>>& frusta, Kept kept, Visible* sum)
  {
    Index count = 0;
    for (FrustumRays<AnyDevice>& frustum : frusta)
    {
      const SeenByRay seen(frustum.States(), kept);
      this->visible.value.Add(frustum.Plan(), seen.visible, count);
      this->unattenuated.value.Add(frustum.Plan(), seen.unattenuated, count);
      count += frustum.Plan().RayCount();
    }
    this->visible.count = this->unattenuated.count = count;
    this->visible.result = &sum->visible;
    this->unattenuated.result = &sum->unattenuated;
  }
};

/// The summands for both parts of what all rays have seen.
struct SumsOfSeen
{
  SumsOfRays all;
  SumsOfRays kept; ///< empty if it is not counted

  /// Empty sums.
  SumsOfSeen() = default;

  /// The results are written to `sum` on the device.
  template <class AnyDevice>
  SumsOfSeen(std::vector<FrustumRays<AnyDevice>>& frusta, Kept counted, Seen* sum)
    : all(frusta, Kept::Ignored, &sum->all)
  {
    if (counted == Kept::Counted)
    {
      this->kept = SumsOfRays(frusta, Kept::Counted, &sum->kept);
    }
  }
};

namespace detail
{
/// Returns what all rays have seen, of one part.
inline Visible SumOfPart(std::vector<FrustumRays<HostDevice>>& frusta, Kept kept)
{
  ExactSum sums[2];
  double cellMeasure = 0; // of all frusta
  for (FrustumRays<HostDevice>& frustum : frusta)
  {
    const SeenByRay seen(frustum.States(), kept);
    AddRays(frustum.Plan(), frustum.RaysAtRest(), seen.visible, sums[0]);
    AddRays(frustum.Plan(), frustum.RaysAtRest(), seen.unattenuated, sums[1]);
    cellMeasure = frustum.Plan().cellMeasure;
  }
  if (!frusta.empty())
  {
    frusta.front().Bands().SumOverAll(sums, 2);
  }
  return { cellMeasure * sums[0].Value(), cellMeasure * sums[1].Value() };
}
}

/// Sums what all rays have seen into `sum` on the device. Asynchronous. `kept`: whether the kept
/// part is summed, too.
template <class AnyDevice>
void SumRays(
  SumOnDevice<AnyDevice>& add, std::vector<FrustumRays<AnyDevice>>& frusta, Kept kept, Seen* sum)
{
  const SumsOfSeen sums(frusta, kept, sum);
  add("sums", sums.all.visible, sums.all.unattenuated, sums.kept.visible, sums.kept.unattenuated);
}

/// The processor sums exactly, over all processes.
inline void SumRays(
  SumOnDevice<HostDevice>&, std::vector<FrustumRays<HostDevice>>& frusta, Kept kept, Seen* sum)
{
  sum->all = detail::SumOfPart(frusta, Kept::Ignored);
  if (kept == Kept::Counted)
  {
    sum->kept = detail::SumOfPart(frusta, Kept::Counted);
  }
}

/// Returns the integral of one value per ray of a frustum to the host; waits for the device.
template <class AnyDevice>
double SumOfRays(
  const std::shared_ptr<AnyDevice>& device, const FrustumRays<AnyDevice>& all, const float* values)
{
  const FaceFrustum& frustum = all.Plan();
  detail::WeightedRays rays;
  rays.Add(frustum, values, 0);
  DeviceArray<AnyDevice, double> there(device, 1, "sums");
  SumOnDevice<AnyDevice> add(device);
  add("sums", Summand<detail::WeightedRays>{ rays, frustum.RayCount(), there.Data() });
  double sum = 0;
  there.Download(&sum);
  return sum;
}

/// The processor sums exactly, over all processes.
inline double SumOfRays(
  const std::shared_ptr<HostDevice>&, const FrustumRays<HostDevice>& all, const float* values)
{
  ExactSum sum;
  AddRays(all.Plan(), all.RaysAtRest(), values, sum);
  all.Bands().SumOverAll(&sum, 1);
  return all.Plan().cellMeasure * sum.Value();
}
}

#endif
