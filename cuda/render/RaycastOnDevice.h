// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_RaycastOnDevice_h
#define limpid_render_RaycastOnDevice_h

#include "backend/CompiledDevice.h"
#include "render/FourFloats.h"
#include "render/RayScene.h"

#include <array>

namespace limpid
{
/**
 * Raycast on a device. The addresses in `scene` and those of the arrays are there. Does not wait.
 *
 * `depth`: see View, null: none; `picture`: room for view.width x view.height times 4 bytes.
 */
template <class Device>
void RaycastOnDevice(Device& device, const RaySceneOf<FourFloats>& scene, const RayMaker& maker,
  const View& view, const std::array<float, 3>& lightColor, const float* depth,
  std::uint32_t* picture);
}

#endif
