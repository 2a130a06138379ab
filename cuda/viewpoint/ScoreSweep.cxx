// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for each device, see CompiledDevice.h.

#include "viewpoint/ScoreSweep.h"

#include "energy/CeilingKernel.h"
#include "energy/ScoreKernel.h"
#include "sweep/Sweeps.h"
#include "viewpoint/SlopeSampler.h"

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

  Seen See(std::vector<ViewFields::Part>&& parts) const override
  {
    Seen sum;
    for (ViewFields::Part& part : parts)
    {
      const Fields& fields = this->FieldsOf(part);
      FrustumRays<AnyDevice> rays = this->RaysOf(part, 0);
      this->Sweep(rays, *part.fields, fields);
      sum += this->SumOf(rays, fields);
    }
    return sum;
  }

  ViewDerivative Differentiate(
    ViewFields::Part&& part, const EyeMoves& moves, int cuts) const override
  {
    const Fields& fields = this->FieldsOf(part);
    const OwnedTables<ViewDerivativePlan> planned =
      PlanViewDerivative(part.outline, part.fields->grid, moves, cuts);
    const BorrowedArray<AnyDevice, unsigned char> tables(
      this->Device, planned.memory.get(), planned.bytes, "the plan of a derivative");
    ViewDerivativePlan plan = planned;
    plan.tables = tables.Data();
    constexpr int edges = 2; // extra voxels that edges of rays and parts of layers read
    FrustumRays<AnyDevice> rays = this->RaysOf(part, edges);
    const FaceFrustum& frustum = rays.Plan();
    auto values = DeviceArray<AnyDevice, float>::Zeros(
      this->Device, std::size_t(EyeMoveStates::images * frustum.RayCount()), "moves of the eye");
    const EyeMoveStates states{ values.Data(), frustum.RayCount() };
    SweepForward<SlopeSampler<AnyDevice>>(*this->Device, rays, *part.fields->occupancy,
      ViewDerivativeKernel<const float*>{
        fields.extinction.Data(), fields.importance.Data(), plan, states });
    const auto sum = [&](const float* image) { return SumOfRays(this->Device, rays, image); };
    return { sum(rays.States()[RayChannel::Visible]),
      { -sum(states.Gain(0)), -sum(states.Gain(1)) } };
  }

private:
  struct Fields
  {
    BorrowedArray<AnyDevice, float> extinction;
    BorrowedArray<AnyDevice, float> importance;
    BorrowedArray<AnyDevice, float> base;  ///< null if all extinction is kept
    BorrowedArray<AnyDevice, float> least; ///< null stands for 0
  };

  void Sweep(FrustumRays<AnyDevice>& rays, const SweptFields& swept, const Fields& fields) const
  {
    if (swept.values.attainable)
    {
      SweepRaysBackward(*this->Device, rays, *swept.occupancy,
        CeilingKernel<const float*, UsualCuts>{ fields.extinction.Data(), fields.importance.Data(),
          fields.least.Data(), { 0, 0 }, Kept::Ignored });
      return;
    }
    SweepForward(*this->Device, rays, *swept.occupancy,
      ScoreKernel<const float*, UsualCuts>{
        fields.extinction.Data(), fields.importance.Data(), fields.base.Data() });
  }

  Seen SumOf(FrustumRays<AnyDevice>& rays, const Fields& fields) const
  {
    const auto sumOf = [&](Kept kept) -> Visible
    {
      const SeenByRay seen(rays.States(), kept);
      return { SumOfRays(this->Device, rays, seen.visible),
        SumOfRays(this->Device, rays, seen.unattenuated) };
    };
    const Visible all = sumOf(Kept::Ignored);
    return { all, fields.base.Data() ? sumOf(Kept::Counted) : all };
  }

  /// Returns the rays of a part, which is consumed. `margin`: see FieldSlabs.
  FrustumRays<AnyDevice> RaysOf(ViewFields::Part& part, int margin) const
  {
    FrustumRays<AnyDevice> rays(this->Device, std::move(part.outline), *part.fields->occupancy);
    if (part.fields->home)
    {
      rays.SweepFieldsOf(*part.fields->home, part.fields->occupancy.get(), margin);
    }
    return rays;
  }

  const Fields& FieldsOf(const ViewFields::Part& part) const
  {
    return part.fields == &this->Source.InOrder() ? this->Straight : this->Exchanged;
  }

  Fields Borrow(const SweptFields& fields) const
  {
    const ViewedFields& values = fields.values;
    const auto count = static_cast<std::size_t>(fields.occupancy ? fields.grid.NodeCount() : 0);
    return { { this->Device, values.extinction, count, "the extinction" },
      { this->Device, values.importance, count, "the importance" },
      { this->Device, values.base, values.base ? count : 0, "the base extinction" },
      { this->Device, values.least, values.least ? count : 0,
        "the lower bound of the extinction" } };
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

template std::unique_ptr<ScoreSweep> MakeScoreSweep(
  std::shared_ptr<CompiledDevice>, const ViewFields&);
}
