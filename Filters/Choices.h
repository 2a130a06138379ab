// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Choices that a user makes by number, by name or by connecting things, and what to say about
// impossible ones.

#ifndef limpid_Choices_h
#define limpid_Choices_h

#include "vtkLimpidFiltersModule.h" // for export macro

#include <string>

class vtkDataArray;
class vtkDataObject;
class vtkDataSet;

namespace limpid
{
/// Throws unless two directions can have an angle [degrees].
VTKLIMPIDFILTERS_EXPORT void RequireAngle(const char* property, double degrees);

/// Throws unless ElevationRange is two elevations, the lower one first [degrees].
VTKLIMPIDFILTERS_EXPORT void RequireElevations(const double range[2]);

/// Throws unless the array has the component; MagnitudeComponent stands for all of them.
VTKLIMPIDFILTERS_EXPORT void RequireComponent(
  const char* property, vtkDataArray* array, int component);

/// The name of an array for a message.
VTKLIMPIDFILTERS_EXPORT std::string NameOf(vtkDataArray* array);

/// The names of all arrays for a message: "of the points: a, b; of the cells: none".
VTKLIMPIDFILTERS_EXPORT std::string ArrayNames(vtkDataSet* data);

/// Why `worker` cannot work with an input; nothing if it is an image, or there is none.
VTKLIMPIDFILTERS_EXPORT std::string RefusalOf(vtkDataObject* input, const std::string& worker);
}

#endif
