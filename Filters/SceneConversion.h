// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Converts an image and its arrays to the grid and the fields of the solver.

#ifndef limpid_SceneConversion_h
#define limpid_SceneConversion_h

#include "ScalarMapping.h"

#include "vtkFloatArray.h"
#include "vtkLimpidFiltersModule.h" // for export macro
#include "vtkSmartPointer.h"
#include "vtkType.h"
#include "vtkUnsignedShortArray.h"

#include "optimize/SceneFields.h"
#include "scene/NodeBox.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

class vtkDataArray;
class vtkImageData;

namespace limpid
{
struct Grid;
class Structures;

/// An array of the image and the component to use.
struct FieldSource
{
  vtkDataArray* array = nullptr;
  bool onCells = false; ///< whether it is a cell array, which is averaged to the points first
  int component = MagnitudeComponent;
  ScalarMapping mapping = KeepValue();

  /// Structures whose labels the values are, which are never averaged or interpolated; null: the
  /// values are numbers.
  std::shared_ptr<const Structures> structures = nullptr;
};

/// An extinction for each GivenReference [1/length]; null: not given.
using References = std::array<vtkSmartPointer<vtkFloatArray>, givenReferences>;

/// Counts points whose values could not be used as they are.
struct VTKLIMPIDFILTERS_EXPORT UnusablePoints
{
  vtkIdType invalid = 0;  ///< NaN or infinity; become empty
  vtkIdType negative = 0; ///< extinction below zero; become empty
  vtkIdType clamped = 0;  ///< importance outside [0, 1]; clamped

  /// Returns a warning; may be empty. `all`: what they are out of.
  std::string Warning(vtkIdType all) const;
};

/// The fields of a scene at the points of the image, and how many values were unusable.
struct VTKLIMPIDFILTERS_EXPORT SceneArrays
{
  vtkSmartPointer<vtkFloatArray> baseExtinction; ///< [1/length]
  vtkSmartPointer<vtkFloatArray> importance;     ///< [0, 1]
  References references;
  vtkSmartPointer<vtkUnsignedShortArray> structureRows; ///< see Structures; null: no structures
  UnusablePoints unusable;
};

/// Returns the grid whose nodes are the points of an image, placed by its extent and direction
/// matrix.
VTKLIMPIDFILTERS_EXPORT Grid GridOfImage(vtkImageData* image);

/// The placement of an image as one message: position of a point, spacing, and direction matrix row
/// by row.
using ImagePlacement = std::array<double, 15>;

/// Returns the placement of the first point of an extent, which may differ from that of the image.
ImagePlacement PlacementOf(vtkImageData* image, const int extent[6]);

/// Returns the grid of an extent whose first point has this placement.
Grid GridOfExtent(const int extent[6], const ImagePlacement& placement);

/// Gives references to a scene, which does not own them.
VTKLIMPIDFILTERS_EXPORT void SetReferences(const References& references, SceneFields& scene);

/// Throws Error unless an array has one value for each point or cell of the image.
void RequireOneEach(vtkImageData* image, const FieldSource& source);

/// Returns a field at the points of the image; NaN where it has no finite value.
VTKLIMPIDFILTERS_EXPORT vtkSmartPointer<vtkFloatArray> ConvertField(
  vtkImageData* image, const FieldSource& source, const char* name);

/// Sets the importance at the points of the image. Of labels, that is the importance of their
/// structures, whose rows are set, too.
VTKLIMPIDFILTERS_EXPORT void ConvertImportance(
  vtkImageData* image, const FieldSource& source, SceneArrays& arrays);

/// Multiplies a field by shares, see Blanking::Shares.
VTKLIMPIDFILTERS_EXPORT void TakeShares(const std::vector<float>& shares, vtkFloatArray* field);

/// Returns both fields of a scene. An empty point has neither extinction nor importance. Importance
/// is clamped to [0, 1].
VTKLIMPIDFILTERS_EXPORT SceneArrays ConvertScene(
  vtkImageData* image, const FieldSource& extinction, const FieldSource& importance);

/// Both fields of a scene, which are converted a box of points at a time. The values are those of
/// ConvertScene.
class LayeredFields
{
public:
  /// Whether that is possible: no values are averaged, no points are blanked, and there are no
  /// structures.
  static bool Suit(
    vtkImageData* image, const FieldSource& extinction, const FieldSource& importance);

  /// The arrays must outlive it.
  LayeredFields(vtkImageData* image, const FieldSource& extinction, const FieldSource& importance);

  /// Writes the fields of a box of points, first axis fastest: base extinction [1/length] and
  /// importance [0, 1].
  void Fill(const NodeBox& box, float* baseExtinction, float* importance);

  /// Returns a warning about the values of all whole layers so far; may be empty.
  std::string Warning() const { return this->Found.Warning(NodeBox::Of(this->Points).Count()); }

private:
  void Convert(const NodeBox& box, float* baseExtinction, float* importance, UnusablePoints& found);

  Int3 Points;
  TupleMapping Extinction;
  TupleMapping Importance;
  int Seen = 0; ///< layers in front of it have been counted
  UnusablePoints Found;
};
}

#endif
