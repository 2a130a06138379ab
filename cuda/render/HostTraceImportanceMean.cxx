// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/Simd.h"
#include "render/HostTrace.h"
#include "render/TraceByImportance.h"

namespace limpid
{
namespace
{
template <bool Overlaid>
void Trace(const RayScene& scene, const Ray& ray, HostPixel& pixel)
{
  RunMultiversioned(
    [&]() LIMPID_INLINE_LAMBDA
    {
      const RayLook look{ scene.gradient != nullptr, scene.structures != nullptr };
      TraceMean<BlockSampler, Overlaid>(scene, ray, look, pixel);
    });
}
}

TraceOneRay HostTraceImportanceMean(const RayScene& scene)
{
  return scene.overlay ? Trace<true> : Trace<false>;
}
}
