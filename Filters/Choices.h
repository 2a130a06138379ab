// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Checks of the user's choices by number, by name or by connection, and the messages for invalid
// ones.

#ifndef limpid_Choices_h
#define limpid_Choices_h

#include "vtkLimpidFiltersModule.h" // for export macro

#include <string>

class vtkDataArray;
class vtkDataObject;
class vtkDataSet;

namespace limpid
{
/// Throws if an angle between two directions is outside its range [degrees].
VTKLIMPIDFILTERS_EXPORT void RequireAngle(const char* property, double degrees);

/// Throws unless ElevationRange has two elevations in ascending order [degrees].
VTKLIMPIDFILTERS_EXPORT void RequireElevations(const double range[2]);

/// Throws unless the array has this component. MagnitudeComponent stands for all components.
VTKLIMPIDFILTERS_EXPORT void RequireComponent(
  const char* property, vtkDataArray* array, int component);

/// Returns the name of an array for a message.
VTKLIMPIDFILTERS_EXPORT std::string NameOf(vtkDataArray* array);

/// Returns the names of all arrays for a message: "of the points: a, b; of the cells: none".
VTKLIMPIDFILTERS_EXPORT std::string ArrayNames(vtkDataSet* data);

/// Returns why `worker` cannot use an input; empty if it is an image or if there is none.
/// `subject`: what the message calls the input.
VTKLIMPIDFILTERS_EXPORT std::string RefusalOf(
  vtkDataObject* input, const std::string& worker, const std::string& subject = "The input");
}

#endif
