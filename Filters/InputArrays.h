// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The arrays of an image that a user chooses with SetInputArrayToProcess.

#ifndef limpid_InputArrays_h
#define limpid_InputArrays_h

#include "SceneConversion.h"

#include "vtkLimpidFiltersModule.h" // for export macro

#include <set>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkImageData;

namespace limpid
{
/// The indices of input arrays are below.
constexpr int endOfInputArrays = firstReferenceArray + static_cast<int>(givenReferences);

/// Returns the array of the points or the cells with a name; null: there is none. `association`:
/// one of vtkDataObject, such as FIELD_ASSOCIATION_POINTS_THEN_CELLS.
VTKLIMPIDFILTERS_EXPORT FieldSource FindField(
  vtkImageData* image, const std::string& name, int association);

/// Returns the name of an input array that the user chose; empty if there is no choice.
VTKLIMPIDFILTERS_EXPORT std::string ChosenName(vtkAlgorithm* owner, int index);

/// Returns the names of all input arrays that the user chose; "" for the scalars, if those are not
/// chosen.
VTKLIMPIDFILTERS_EXPORT std::set<std::string> ChosenNames(vtkAlgorithm* owner);

/// Returns an array for each GivenReference, which the user chose among the input arrays of an
/// algorithm. It is null if none is chosen, or without an image.
VTKLIMPIDFILTERS_EXPORT std::vector<FieldSource> ReferenceSources(
  vtkAlgorithm* owner, vtkImageData* image);

/// Chooses the further arrays of one algorithm, those of structures and references, in another one,
/// too.
VTKLIMPIDFILTERS_EXPORT void CopyFurtherArrays(vtkAlgorithm* from, vtkAlgorithm* to);
}

#endif
