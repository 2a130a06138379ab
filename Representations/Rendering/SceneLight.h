// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The light of a view that casts the shadows and drives the optimisation.

#ifndef limpid_SceneLight_h
#define limpid_SceneLight_h

#include "scene/RaySource.h"

#include <array>
#include <string>

class vtkRenderer;

namespace limpid
{
struct ChosenLight
{
  bool found = false;
  Light light;                                        ///< in world coordinates
  std::array<float, 3> color{ { 1.0f, 1.0f, 1.0f } }; ///< largest channel: 1
  std::string description;                            ///< for the user
};

/// The strongest of the renderer's lights that are switched on, by the brightness of its diffuse
/// colour times its intensity; of equally strong ones the first. Its own brightness is not used
/// otherwise: one light stands for all of them.
ChosenLight StrongestLight(vtkRenderer* renderer);
}

#endif
