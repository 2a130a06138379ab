// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "viewpoint/ScoreSweepOnDevice.h"

#include "backend/SumOnDevice.h"
#include "energy/TermKernels.h"
#include "sweep/FrustumOnDevice.h"

namespace limpid
{
namespace
{
template <class Device>
class DeviceScoreSweep : public ScoreSweep
{
public:
  DeviceScoreSweep(std::shared_ptr<Device> device, const ViewFields& fields)
    : Home(std::move(device))
    , Source(fields)
    , Straight(this->Copy(fields.InOrder()))
    , Exchanged(this->Copy(fields.WithAxesExchanged()))
  {
  }

  Visible Score(const std::vector<ViewFields::Part>& parts) const override
  {
    Visible sum;
    for (const ViewFields::Part& part : parts)
    {
      const SweptFields& swept = *part.fields;
      const Fields& fields = &swept == &this->Source.InOrder() ? this->Straight : this->Exchanged;
      const FrustumOnDevice<Device> plan(
        this->Home, part.frustum, swept.grid, *swept.occupancy, Readers::Rays);
      const std::size_t count = plan.RayCount();
      DeviceArray<Device, float> gathered(this->Home, 2 * count, "rays");
      DeviceArray<Device, double> sums(this->Home, 2, "sums");
      SumOnDevice<Device> add(this->Home);
      float* visible = gathered.Data();
      float* unattenuated = visible + count;
      this->Home->ForEach("score", plan.Rays(),
        ForwardRay{ plan.View(), fields.extinction.Data(), fields.importance.Data(), nullptr,
          { visible, unattenuated } });
      const double* shares = plan.View().shares;
      add("score", static_cast<Index>(count), WeightedRay{ shares, visible }, sums.Data());
      add("score", static_cast<Index>(count), WeightedRay{ shares, unattenuated }, sums.Data() + 1);
      double values[2];
      sums.Download(values);
      sum.visible += values[0];
      sum.unattenuated += values[1];
    }
    return sum;
  }

private:
  struct Fields
  {
    DeviceArray<Device, float> extinction;
    DeviceArray<Device, float> importance;
  };

  Fields Copy(const SweptFields& fields) const
  {
    return { { this->Home, fields.extinction, "the extinction" },
      { this->Home, fields.importance, "the importance" } };
  }

  std::shared_ptr<Device> Home;
  const ViewFields& Source;
  Fields Straight;
  Fields Exchanged;
};
}

template <class Device>
std::unique_ptr<ScoreSweep> ScoreSweepOn(std::shared_ptr<Device> device, const ViewFields& fields)
{
  return std::make_unique<DeviceScoreSweep<Device>>(std::move(device), fields);
}

template std::unique_ptr<ScoreSweep> ScoreSweepOn(
  std::shared_ptr<CompiledDevice>, const ViewFields&);
}
