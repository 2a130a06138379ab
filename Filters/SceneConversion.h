// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// From an image and its arrays to the grid and the fields that the solver works on.

#ifndef limpid_SceneConversion_h
#define limpid_SceneConversion_h

#include "ScalarMapping.h"

#include "vtkFloatArray.h"
#include "vtkLimpidFiltersModule.h" // for export macro
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <string>
#include <vector>

class vtkDataArray;
class vtkImageData;

namespace limpid
{
struct Grid;

/// An array of the image and what to make of it.
struct FieldSource
{
  vtkDataArray* array = nullptr;
  bool onCells = false; ///< an array of the cells: averaged to the points first
  int component = MagnitudeComponent;
  ScalarMapping mapping = KeepValue();
};

/// The fields of a scene at the points of the image, and what had to be left out.
struct VTKLIMPIDFILTERS_EXPORT SceneArrays
{
  vtkSmartPointer<vtkFloatArray> baseExtinction; ///< [1/length]
  vtkSmartPointer<vtkFloatArray> importance;     ///< [0, 1]
  vtkIdType invalidPoints = 0;                   ///< NaN or infinity: empty
  vtkIdType negativePoints = 0;                  ///< extinction below zero: empty
  vtkIdType clampedPoints = 0;                   ///< importance outside [0, 1]: moved there
  vtkIdType allPoints = 0;                       ///< that these are of; 0: those of the arrays

  /// What a user has to know about values that could not be taken as they are; may be nothing.
  std::string Warning() const;
};

/// The nodes of an image: its points. Extent and direction matrix are part of the placement.
VTKLIMPIDFILTERS_EXPORT Grid GridOfImage(vtkImageData* image);

/// Where an image is, as one message: position of a point, spacing, and direction matrix row by
/// row.
using ImagePlacement = std::array<double, 15>;

/// The placement of the first point of an extent, which may be another one than the image's.
ImagePlacement PlacementOf(vtkImageData* image, const int extent[6]);

/// The grid of an extent whose first point is placed so.
Grid GridOfExtent(const int extent[6], const ImagePlacement& placement);

/// A field at the points of the image; NaN where it has no finite value.
VTKLIMPIDFILTERS_EXPORT vtkSmartPointer<vtkFloatArray> ConvertField(
  vtkImageData* image, const FieldSource& source, const char* name);

/// Leaves of a field what Blanking::Shares says.
VTKLIMPIDFILTERS_EXPORT void TakeShares(const std::vector<float>& shares, vtkFloatArray* field);

/// Both fields of a scene. An empty point has neither extinction nor importance; importance is
/// moved into [0, 1].
VTKLIMPIDFILTERS_EXPORT SceneArrays ConvertScene(
  vtkImageData* image, const FieldSource& extinction, const FieldSource& importance);
}

#endif
