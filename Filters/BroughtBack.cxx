// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Results at the points of an image, brought back to the data that it was made of.

#include "SampledData.h"

#include "AllCores.h"
#include "ControllerRanks.h"
#include "DataLeaves.h"
#include "FieldValues.h"
#include "Memory.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkHyperTreeGrid.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"

#include "math/Require.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace limpid
{
namespace
{
/// Where a position is in an image: the first point of its cell, and the shares of the cell.
struct PlaceInImage
{
  std::array<int, 3> first;
  std::array<double, 3> share;

  PlaceInImage(vtkImageData* image, const double position[3])
  {
    const double* origin = image->GetOrigin();
    const double* spacing = image->GetSpacing();
    const int* points = image->GetDimensions();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double index = (position[axis] - origin[axis]) / spacing[axis];
      const double inside = std::min(std::max(index, 0.0), double(points[axis] - 1));
      this->first[axis] = std::min(int(inside), points[axis] - 2);
      this->share[axis] = inside - this->first[axis];
    }
  }

  double Interpolate(const float* values, const int* points) const
  {
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner)
    {
      vtkIdType number = 0;
      double weight = 1;
      for (int axis = 2; axis >= 0; --axis)
      {
        const auto at = static_cast<std::size_t>(axis);
        const int step = corner >> axis & 1;
        number = number * points[axis] + this->first[at] + step;
        weight *= step != 0 ? this->share[at] : 1 - this->share[at];
      }
      sum += weight * double(values[number]);
    }
    return sum;
  }
};

void AddInterpolated(vtkImageData* image, vtkFloatArray* values, vtkDataSet* leaf)
{
  const int* points = image->GetDimensions();
  const vtkIdType count = leaf->GetNumberOfPoints();
  const auto there = NewArray<vtkFloatArray>(values->GetName(), count);
  ForOnAllCores(count,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType point = begin; point < end; ++point)
      {
        double position[3];
        leaf->GetPoint(point, position);
        const PlaceInImage place(image, position);
        there->SetValue(
          point, static_cast<float>(place.Interpolate(values->GetPointer(0), points)));
      }
    });
  leaf->GetPointData()->AddArray(there);
}

/// Copies data so that arrays can be added to the copy alone.
void CopyWithLeaves(vtkDataObject* data, vtkDataObject* output)
{
  auto* blocks = vtkCompositeDataSet::SafeDownCast(data);
  auto* copies = vtkCompositeDataSet::SafeDownCast(output);
  if (!blocks || !copies)
  {
    output->ShallowCopy(data);
    return;
  }
  copies->CopyStructure(blocks);
  vtkSmartPointer<vtkCompositeDataIterator> block;
  block.TakeReference(blocks->NewIterator());
  for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
  {
    vtkSmartPointer<vtkDataObject> copy;
    copy.TakeReference(block->GetCurrentDataObject()->NewInstance());
    copy->ShallowCopy(block->GetCurrentDataObject());
    copies->SetDataSet(block, copy);
  }
  output->GetFieldData()->ShallowCopy(data->GetFieldData());
}
}

void RequirePoints(vtkDataObject* data)
{
  LIMPID_REQUIRE(!AreSeveral(),
    "The input is a " << data->GetClassName()
                      << " (on several processes, this filter works on a single image with uniform "
                         "spacing). Make it one with the filter Resample To Image.");
  LIMPID_REQUIRE(!vtkHyperTreeGrid::SafeDownCast(data),
    "The input is a vtkHyperTreeGrid (its points cannot have results). Make it an unstructured "
    "grid with the filter HyperTreeGrid To UnstructuredGrid.");
}

void BringBack(
  const SampledData& sampled, vtkImageData* result, vtkDataObject* data, vtkDataObject* output)
{
  CopyWithLeaves(data, output);
  vtkPointData* points = result->GetPointData();
  for (const Leaf& leaf : LeavesOf(output))
  {
    for (int i = 0; i < points->GetNumberOfArrays(); ++i)
    {
      auto* values = vtkFloatArray::SafeDownCast(points->GetArray(i));
      const bool isNew =
        values && values != sampled.image->GetPointData()->GetArray(values->GetName());
      if (isNew && values->GetNumberOfComponents() == 1)
      {
        AddInterpolated(result, values, leaf);
      }
    }
  }
  for (int i = 0; i < result->GetFieldData()->GetNumberOfArrays(); ++i)
  {
    output->GetFieldData()->AddArray(result->GetFieldData()->GetAbstractArray(i));
  }
  AddValue<vtkStringArray>("SampledAt", sampled.text, output->GetFieldData());
}
}
