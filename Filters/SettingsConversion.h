// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Converts vtkVisibilitySettings to the settings of the core.

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

/// Returns weights, solver and backend.
VTKLIMPIDFILTERS_EXPORT Settings SettingsOf(vtkVisibilitySettings* settings);

/// Returns the cameras that share an extinction.
VTKLIMPIDFILTERS_EXPORT ViewSet ViewSetOf(vtkVisibilitySettings* settings);

/// Returns the light in world coordinates. A directional light shines towards the focal point.
VTKLIMPIDFILTERS_EXPORT Light LightOf(vtkVisibilitySettings* settings, const Vec3& focalPoint);

/// Returns the mapping from values of the importance array to importance. Throws if its function is
/// missing.
VTKLIMPIDFILTERS_EXPORT ScalarMapping ImportanceMapping(vtkVisibilitySettings* settings);
}

#endif
