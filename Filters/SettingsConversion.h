// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// From vtkVisibilitySettings to what the core takes.

#ifndef limpid_SettingsConversion_h
#define limpid_SettingsConversion_h

#include "ScalarMapping.h"

#include "vtkLimpidFiltersModule.h" // for export macro

#include "math/Vec.h"

class vtkVisibilitySettings;

namespace limpid
{
struct Light;
struct Settings;
struct ViewSet;

/// Weights, solver and backend.
VTKLIMPIDFILTERS_EXPORT Settings SettingsOf(vtkVisibilitySettings* settings);

/// For which cameras.
VTKLIMPIDFILTERS_EXPORT ViewSet ViewSetOf(vtkVisibilitySettings* settings);

/// The light in world coordinates; a directional one shines towards the focal point.
VTKLIMPIDFILTERS_EXPORT Light LightOf(vtkVisibilitySettings* settings, const Vec3& focalPoint);

/// From values of the importance array to importance. Throws when the function for it is missing.
VTKLIMPIDFILTERS_EXPORT ScalarMapping ImportanceMapping(vtkVisibilitySettings* settings);
}

#endif
