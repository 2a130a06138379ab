// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/ScoreSweep.h"

namespace limpid
{
namespace
{
class ProcessorScoreSweep : public ScoreSweep
{
public:
  Visible Score(const std::vector<ViewFields::Part>& parts) const override
  {
    Visible sum;
    for (const ViewFields::Part& part : parts)
    {
      RayImages images(part.frustum);
      const SweptFields& fields = *part.fields;
      const Visible score = SweepForward(part.frustum,
        { &fields.grid, fields.occupancy.get(), fields.extinction.data(),
          fields.importance.data() },
        images);
      sum.visible += score.visible;
      sum.unattenuated += score.unattenuated;
    }
    return sum;
  }
};
}

std::unique_ptr<ScoreSweep> CpuScoreSweep()
{
  return std::make_unique<ProcessorScoreSweep>();
}
}
