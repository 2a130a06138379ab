// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/Simd.h"
#include "render/HostTrace.h"
#include "render/TraceRay.h"

namespace limpid
{
namespace
{
template <bool Lit, bool Overlaid>
void Trace(const RayScene& scene, const Ray& ray, HostPixel& pixel)
{
  RunMultiversioned(
    [&]() LIMPID_INLINE_LAMBDA
    {
      const RayLook look{ Lit, scene.structures != nullptr };
      TraceRay<BlockSampler, Overlaid>(scene, ray, look, pixel);
    });
}
}

TraceOneRay HostTraceFrontToBack(const RayScene& scene)
{
  constexpr TraceOneRay all[2][2] = { { Trace<false, false>, Trace<false, true> },
    { Trace<true, false>, Trace<true, true> } };
  return all[scene.gradient != nullptr][scene.overlay != nullptr];
}
}
