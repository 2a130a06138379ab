// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Lights with names, for tests of the transmittance from each.

#ifndef limpid_testing_Lamp_h
#define limpid_testing_Lamp_h

#include "BoxScene.h"

#include <ostream>

namespace limpid
{
struct Lamp
{
  const char* name;
  LightType type;
  Vec3 position; ///< point: in half diagonals from the centre; directional: where it comes from
  double rayDensity = 2;
};

inline std::ostream& operator<<(std::ostream& stream, const Lamp& lamp)
{
  return stream << lamp.name;
}

/// An empty box away from the origin in the light of a lamp.
inline BoxScene BoxUnder(const Lamp& lamp, const Int3& nodes)
{
  BoxScene scene(nodes, { 100, -50, 3 }, { 1.0, 0.8, 1.3 });
  scene.light.type = lamp.type;
  scene.light.position = scene.grid.Centre() + scene.grid.Radius() * lamp.position;
  scene.light.focalPoint = scene.grid.Centre();
  return scene;
}
}

#endif
