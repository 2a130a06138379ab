// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "render/RaycastOnDevice.h"

#include "render/PixelRay.h"

#include <algorithm>

namespace limpid
{
template <class Device>
void RaycastOnDevice(Device& device, const RaySceneOf<FourFloats>& scene, const RayMaker& maker,
  const View& view, const std::array<float, 3>& lightColor, const float* depth,
  std::uint32_t* picture)
{
  const PixelTiles tiles{ view.width, view.height };
  const auto cast = [&](const char* label, auto ray)
  {
    ray.scene = scene;
    ray.depth = depth;
    std::copy(lightColor.begin(), lightColor.end(), ray.lightColor);
    ray.picture = picture;
    device.ForEach(label, tiles.Threads(), ray);
  };
  if (scene.gradient && scene.overlay)
  {
    cast("cast lit rays in a overlay", PixelRay<true, true>{ {}, maker, tiles, {}, {}, {} });
  }
  else if (scene.gradient)
  {
    cast("cast lit rays", PixelRay<true, false>{ {}, maker, tiles, {}, {}, {} });
  }
  else if (scene.overlay)
  {
    cast("cast rays in a overlay", PixelRay<false, true>{ {}, maker, tiles, {}, {}, {} });
  }
  else
  {
    cast("cast rays", PixelRay<false, false>{ {}, maker, tiles, {}, {}, {} });
  }
}

template void RaycastOnDevice(CompiledDevice&, const RaySceneOf<FourFloats>&, const RayMaker&,
  const View&, const std::array<float, 3>&, const float*, std::uint32_t*);
}
