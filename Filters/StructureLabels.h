// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Labels of structures, such as those of a segmentation, as importance.

#ifndef limpid_StructureLabels_h
#define limpid_StructureLabels_h

#include "SceneConversion.h"

#include "vtkLimpidFiltersModule.h" // for export macro

#include "scene/Structures.h"

#include <string>

class vtkAlgorithm;
class vtkImageData;
class vtkVisibilitySettings;

namespace limpid
{
/// Input array that has the labels, see vtkVisibilityAlgorithm.
constexpr int structureArray = 3;

/// Returns the structures of settings; without any, all labels but 0 are one structure. Throws
/// Error for rows that are none.
VTKLIMPIDFILTERS_EXPORT Structures StructuresOf(vtkVisibilitySettings* settings);

/// Returns the label array that the user chose among the input arrays of an algorithm, with the
/// structures of its settings. The array is null if none is chosen.
VTKLIMPIDFILTERS_EXPORT FieldSource StructureSource(
  vtkAlgorithm* owner, vtkVisibilitySettings* settings, vtkImageData* image);

/// Returns a warning about a source of labels without structures; may be empty.
VTKLIMPIDFILTERS_EXPORT std::string WarningOf(const FieldSource& structures);

/// Returns the row of the structure at each point. Labels on cells: that of most cells around the
/// point; if several structures have as many, that of the first row. Throws Error if values are not
/// labels.
vtkSmartPointer<vtkUnsignedShortArray> RowsAtPoints(vtkImageData* image, const FieldSource& source);
}

#endif
