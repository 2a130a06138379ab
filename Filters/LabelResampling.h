// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Labels of one image at the points of another one.

#ifndef limpid_LabelResampling_h
#define limpid_LabelResampling_h

#include "SceneConversion.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <map>
#include <vector>

class vtkDataArray;
class vtkImageData;

namespace limpid
{
/// How a point gets its label, see vtkAddStructures.
enum class Resampling
{
  Majority,
  Nearest
};

/// Labels of structures that were given as masks.
struct MaskLabels
{
  vtkSmartPointer<vtkDataArray> labels; ///< n where the n-th mask is the last one; 0: none
  vtkIdType overlaps = 0;               ///< number of values that belong to several masks
};

/// Returns the labels of an array with one component as integers in contiguous memory. They have
/// the array's type; labels in floating point become int, and NaN becomes 0. Throws Error for
/// values that are not whole numbers.
vtkSmartPointer<vtkDataArray> WholeLabels(vtkDataArray* array);

/// Returns labels for masks, each a component of an array. Integers other than 0 and floating-point
/// numbers above 0.5 are inside. All arrays must have as many values.
MaskLabels LabelsOfMasks(const std::vector<FieldSource>& masks);

/// Returns the array "Structure" of the points of `image`, of the type of `labels`. These are
/// values of WholeLabels, one per point or cell of `labelled`, x fastest. May throw Interrupted.
vtkSmartPointer<vtkDataArray> ResampleLabels(const Grid& image, const Grid& labelled,
  vtkDataArray* labels, bool onCells, Resampling resampling);

/// Returns how often each value of an array occurs. The values are those of WholeLabels.
std::map<std::int64_t, vtkIdType> CountLabels(vtkDataArray* labels);
}

#endif
