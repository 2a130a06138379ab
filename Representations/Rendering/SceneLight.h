// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The light of a view that casts the shadows and drives the optimisation.

#ifndef limpid_SceneLight_h
#define limpid_SceneLight_h

#include "scene/RaySource.h"

#include <string>

class vtkRenderer;
class vtkVisibilitySettings;
class vtkVolume;

namespace limpid
{
struct ChosenLight
{
  bool found = false;
  Light light; ///< in world coordinates, see ToData
  bool movesWithCamera = false;
  std::string description; ///< for the user
};

/// Returns the light of the settings; if nobody has placed it, it is above and behind the camera.
ChosenLight OwnLight(vtkVisibilitySettings* settings, vtkRenderer* renderer);

/// Returns the strongest of the renderer's lights that are switched on, by the brightness of its
/// diffuse colour times its intensity; the first one if several are equal. Its brightness is not
/// used otherwise: one light stands for all.
ChosenLight StrongestLight(vtkRenderer* renderer);

/// Converts a light to data coordinates.
Light ToData(const Light& light, vtkVolume* volume);
}

#endif
