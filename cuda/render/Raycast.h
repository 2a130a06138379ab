// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_Raycast_h
#define limpid_render_Raycast_h

#include "render/RaySamples.h"
#include "render/Renderer.h"

namespace limpid
{
/// Casts a ray through every pixel of a view. `maker`: of its rays.
void Raycast(const RayScene& scene, const RayMaker& maker, const View& view,
  const std::array<float, 3>& lightColor, Picture& picture);
}

#endif
