// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "viewpoint/ScoreSweep.h"

#include "energy/ScoreKernel.h"
#include "sweep/Sweeps.h"

namespace limpid
{
namespace
{
template <class AnyDevice>
class ScoreSweepOn : public ScoreSweep
{
public:
  ScoreSweepOn(std::shared_ptr<AnyDevice> device, const ViewFields& fields)
    : Device(std::move(device))
    , Source(fields)
    , Straight(this->Borrow(fields.InOrder()))
    , Exchanged(this->Borrow(fields.WithAxesExchanged()))
  {
  }

  Visible Score(std::vector<ViewFields::Part>&& parts) const override
  {
    Visible sum;
    for (ViewFields::Part& part : parts)
    {
      const Fields& fields =
        part.fields == &this->Source.InOrder() ? this->Straight : this->Exchanged;
      std::vector<FrustumRays<AnyDevice>> rays;
      rays.emplace_back(this->Device, std::move(part.frustum));
      SweepForward(*this->Device, rays.front(), *part.fields->occupancy,
        ScoreKernel<const float*>{ fields.extinction.Data(), fields.importance.Data() });
      SumOnDevice<AnyDevice> add(this->Device);
      DeviceArray<AnyDevice, Visible> there(this->Device, 1, "sums");
      SumRays(rays, add, there.Data(), 0);
      Visible seen;
      there.Download(&seen);
      sum += seen;
    }
    return sum;
  }

private:
  struct Fields
  {
    BorrowedArray<AnyDevice, float> extinction;
    BorrowedArray<AnyDevice, float> importance;
  };

  Fields Borrow(const SweptFields& fields) const
  {
    const std::size_t count = fields.extinction.size();
    return { { this->Device, fields.extinction.data(), count, "the extinction" },
      { this->Device, fields.importance.data(), count, "the importance" } };
  }

  std::shared_ptr<AnyDevice> Device;
  const ViewFields& Source;
  Fields Straight;
  Fields Exchanged;
};
}

template <class AnyDevice>
std::unique_ptr<ScoreSweep> MakeScoreSweep(
  std::shared_ptr<AnyDevice> device, const ViewFields& fields)
{
  return std::make_unique<ScoreSweepOn<AnyDevice>>(std::move(device), fields);
}

#define LIMPID_INSTANTIATE(AnyDevice)                                                              \
  template std::unique_ptr<ScoreSweep> MakeScoreSweep(                                             \
    std::shared_ptr<AnyDevice>, const ViewFields&);
LIMPID_FOR_EACH_COMPILED_DEVICE(LIMPID_INSTANTIATE)
}
