// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/RayCaster.h"

#include "render/RenderPasses.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace limpid
{
namespace
{
/// Drops depths at which no ray ends or begins earlier than without them.
View WithoutNeedlessDepths(View view)
{
  const auto drop = [&](const float*& depths, float bound)
  {
    const std::size_t pixels = std::size_t(view.width) * std::size_t(view.height);
    const auto isBound = [bound](float depth) { return depth == bound; };
    if (depths && std::all_of(depths, depths + pixels, isBound))
    {
      depths = nullptr;
    }
  };
  drop(view.depth, 1);
  drop(view.nearDepth, -1);
  return view;
}

/// The passes of the processor, without those that the caster can do. It is told what changes.
class CastElsewhere : public RenderPasses<HostDevice>
{
public:
  explicit CastElsewhere(std::shared_ptr<RayCaster> caster)
    : RenderPasses(HostDevice::Shared())
    , Caster(std::move(caster))
  {
  }

  void SetScalars(const DrawnPart& part, const ScalarNodes& scalars, const float* shares) override
  {
    ++this->Versions.scalars;
    RenderPasses::SetScalars(part, scalars, shares);
  }

  void SetTransferFunctions(const Classification& classification) override
  {
    ++this->Versions.functions;
    RenderPasses::SetTransferFunctions(classification);
  }

  void SetExtinction(const DrawnPart& part, const float* base, const float* extinction,
    double share, const float* lightExtinction) override
  {
    ++this->Versions.overlay;
    RenderPasses::SetExtinction(part, base, extinction, share, lightExtinction);
  }

  void ShowThere(const Grid& grid, const float* base, const float* extinction, double share,
    const float* lightExtinction) override
  {
    ++this->Versions.overlay;
    RenderPasses::ShowThere(grid, base, extinction, share, lightExtinction);
  }

  void UseTransferFunction(const DrawnPart& part) override
  {
    ++this->Versions.overlay;
    RenderPasses::UseTransferFunction(part);
  }

  void CastShadows(const DrawnPart& part, const RaySource& light, double rayDensity) override
  {
    ++this->Versions.shadow;
    RenderPasses::CastShadows(part, light, rayDensity);
  }

  void FindGradient() override
  {
    ++this->Versions.gradient;
    RenderPasses::FindGradient();
  }

  void FindEmptyBricks() override
  {
    ++this->Versions.bricks;
    RenderPasses::FindEmptyBricks();
  }

  void FindBareBricks() override
  {
    ++this->Versions.bareBricks;
    RenderPasses::FindBareBricks();
  }

  void SetImportance(const float* importance) override
  {
    ++this->Versions.importance;
    RenderPasses::SetImportance(importance);
  }

  void SetStructures(const StructureRow* rows) override
  {
    ++this->Versions.structures;
    RenderPasses::SetStructures(rows);
  }

  void Cast(const Casting& casting, const View& view, Picture& picture) override
  {
    CastTask task{ this->Drawn(), casting, WithoutNeedlessDepths(view),
      this->SceneWithShadow(casting), {}, this->Versions };
    if (casting.missedColor)
    {
      task.missed = this->MissedSceneOf(casting);
    }
    std::vector<PartialPixel> parts(picture.foremost.size());
    if (!this->Caster->Cast(task, picture, parts))
    {
      RenderPasses::Cast(casting, view, picture);
    }
    else if (!parts.empty())
    {
      Compose(this->Drawn(), parts, casting.opaqueBelow, picture);
    }
  }

private:
  std::shared_ptr<RayCaster> Caster;
  FieldVersions Versions;
};
}

std::unique_ptr<RenderBackend> BackendWith(std::shared_ptr<RayCaster> caster)
{
  return std::make_unique<CastElsewhere>(std::move(caster));
}
}
