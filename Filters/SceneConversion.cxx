// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SceneConversion.h"

#include "Choices.h"

#include "vtkCellData.h"
#include "vtkCellDataToPointData.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUniformGrid.h"
#include "vtkUnsignedCharArray.h"

#include "math/Require.h"
#include "optimize/Solver.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <sstream>

namespace limpid
{
namespace
{
// The chosen component of a cell array, averaged to the points, before any mapping: transfer
// functions apply to the data at the points, as they do for point arrays.
vtkSmartPointer<vtkFloatArray> AverageToPoints(vtkImageData* image, const FieldSource& source)
{
  vtkNew<vtkFloatArray> cellValues;
  cellValues->SetName("value");
  cellValues->SetNumberOfTuples(source.array->GetNumberOfTuples());
  MapArray(source.array, source.component, KeepValue(), cellValues->GetPointer(0));

  vtkNew<vtkUniformGrid> cells; // a vtkUniformGrid knows hidden cells, which do not count
  cells->CopyStructure(image);
  cells->GetCellData()->AddArray(cellValues);
  if (vtkUnsignedCharArray* ghosts = image->GetCellGhostArray())
  {
    cells->GetCellData()->AddArray(ghosts);
  }
  vtkNew<vtkCellDataToPointData> average;
  average->SetInputData(cells);
  average->Update();
  return vtkFloatArray::SafeDownCast(
    average->GetImageDataOutput()->GetPointData()->GetArray("value"));
}

// Whether no value is negative, above `largest` or not finite: the usual case, in a loop that
// vectorises. Such floating-point numbers have the order of their bits, read as integers.
bool AreWithin(vtkFloatArray* array, float largest)
{
  std::uint32_t largestBits;
  std::memcpy(&largestBits, &largest, sizeof(largestBits));
  const float* values = array->GetPointer(0);
  const vtkIdType count = array->GetNumberOfTuples();
  unsigned outside = 0;
  for (vtkIdType i = 0; i < count; ++i)
  {
    std::uint32_t bits;
    std::memcpy(&bits, values + i, sizeof(bits));
    outside |= bits > largestBits ? 1U : 0U;
  }
  return outside == 0;
}

// Makes points empty that cannot be used, and moves importance into [0, 1].
void CorrectPoints(SceneArrays& arrays, vtkUnsignedCharArray* ghosts)
{
  float* extinction = arrays.baseExtinction->GetPointer(0);
  float* importance = arrays.importance->GetPointer(0);
  const vtkIdType count = arrays.baseExtinction->GetNumberOfTuples();
  for (vtkIdType i = 0; i < count; ++i)
  {
    const bool hidden = ghosts && (ghosts->GetValue(i) & vtkDataSetAttributes::HIDDENPOINT) != 0;
    const bool invalid = !hidden && !(std::isfinite(extinction[i]) && std::isfinite(importance[i]));
    const bool negative = !hidden && !invalid && extinction[i] < 0;
    arrays.hiddenPoints += hidden ? 1 : 0;
    arrays.invalidPoints += invalid ? 1 : 0;
    arrays.negativePoints += negative ? 1 : 0;
    if (hidden || invalid || negative)
    {
      extinction[i] = 0;
      importance[i] = 0;
    }
    else if (!(importance[i] >= 0 && importance[i] <= 1))
    {
      importance[i] = std::min(std::max(importance[i], 0.0F), 1.0F);
      ++arrays.clampedPoints;
    }
  }
}
}

std::string SceneArrays::Warning() const
{
  std::ostringstream text;
  const auto report = [this, &text](vtkIdType points, const char* what)
  {
    if (points > 0)
    {
      text << (text.tellp() > 0 ? " " : "") << points << " of "
           << this->baseExtinction->GetNumberOfTuples() << " points have " << what;
    }
  };
  report(this->invalidPoints,
    "a NaN or an infinite value (nothing can be computed from it) and are taken as empty. Replace "
    "these values if they should count.");
  report(this->negativePoints,
    "a negative extinction (it would make light from nothing) and are taken as empty. Give an "
    "extinction of zero or more.");
  report(this->clampedPoints,
    "an importance outside [0, 1] (it is a share) and get 0 or 1. Map the values to importance "
    "with ImportanceFunction.");
  return text.str();
}

Grid GridOfImage(vtkImageData* image)
{
  Grid grid;
  int extent[6];
  image->GetExtent(extent);
  double first[3];
  image->TransformIndexToPhysicalPoint(extent[0], extent[2], extent[4], first);
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.nodes[axis] = std::max(0, extent[2 * axis + 1] - extent[2 * axis] + 1);
    grid.origin[axis] = first[axis];
    grid.spacing[axis] = image->GetSpacing()[axis];
    for (int row = 0; row < 3; ++row)
    {
      grid.direction[axis][row] = image->GetDirectionMatrix()->GetElement(row, axis);
    }
  }
  grid.Require();
  return grid;
}

vtkSmartPointer<vtkFloatArray> ConvertField(
  vtkImageData* image, const FieldSource& source, const char* name)
{
  vtkNew<vtkFloatArray> field;
  field->SetName(name);
  field->SetNumberOfTuples(image->GetNumberOfPoints());
  const vtkIdType expected =
    source.onCells ? image->GetNumberOfCells() : image->GetNumberOfPoints();
  LIMPID_REQUIRE(source.array->GetNumberOfTuples() == expected,
    "The array \""
      << NameOf(source.array) << "\" has " << source.array->GetNumberOfTuples() << " values for "
      << expected << (source.onCells ? " cells" : " points")
      << " (values cannot be told apart by place). Give an array with one value for each.");

  if (source.onCells)
  {
    const vtkSmartPointer<vtkFloatArray> averaged = AverageToPoints(image, source);
    MapArray(averaged, MagnitudeComponent, source.mapping, field->GetPointer(0));
  }
  else
  {
    MapArray(source.array, source.component, source.mapping, field->GetPointer(0));
  }
  return field;
}

SceneArrays ConvertScene(
  vtkImageData* image, const FieldSource& extinction, const FieldSource& importance)
{
  SceneArrays arrays;
  arrays.baseExtinction = ConvertField(image, extinction, "BaseExtinction");
  arrays.importance = ConvertField(image, importance, "Importance");
  vtkUnsignedCharArray* ghosts = image->GetPointGhostArray();
  constexpr float largest = std::numeric_limits<float>::max();
  if (ghosts || !AreWithin(arrays.baseExtinction, largest) || !AreWithin(arrays.importance, 1))
  {
    CorrectPoints(arrays, ghosts);
  }
  return arrays;
}
}
