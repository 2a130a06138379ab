// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/PartScorer.h"

namespace limpid
{
namespace
{
class ProcessorPartScorer : public PartScorer
{
public:
  Visible Score(const std::vector<ViewFields::Part>& parts) const override
  {
    Visible sum;
    for (const ViewFields::Part& part : parts)
    {
      RayImages images(part.pyramid);
      const SweptFields& fields = *part.fields;
      const Visible score = SweepForward(part.pyramid,
        { &fields.grid, fields.occupancy.get(), fields.extinction.data(),
          fields.importance.data() },
        images);
      sum.visible += score.visible;
      sum.plain += score.plain;
    }
    return sum;
  }
};
}

std::unique_ptr<PartScorer> CpuPartScorer()
{
  return std::make_unique<ProcessorPartScorer>();
}
}
