// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Results at the points of an image, brought back to the data that it was made of.

#include "SampledData.h"

#include "AllCores.h"
#include "FieldValues.h"
#include "LatticeSamples.h"
#include "Memory.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkHyperTreeGrid.h"
#include "vtkHyperTreeGridNonOrientedGeometryCursor.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"

#include "distributed/Communicator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
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
    const int* extent = image->GetExtent();
    const int* points = image->GetDimensions();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double index =
        (position[axis] - origin[axis]) / spacing[axis] - double(extent[2 * axis]);
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

/// The places of a data set that get results.
struct Places
{
  vtkDataSetAttributes* attributes;
  vtkIdType count;
  std::function<void(vtkIdType number, double position[3])> find;
};

Places PointsIn(vtkDataSet* data)
{
  return { data->GetPointData(), data->GetNumberOfPoints(),
    [data](vtkIdType point, double position[3]) { data->GetPoint(point, position); } };
}

void AddCentres(
  vtkHyperTreeGridNonOrientedGeometryCursor* cell, std::vector<std::array<double, 3>>& centres)
{
  const auto number = static_cast<std::size_t>(cell->GetGlobalNodeIndex());
  centres.resize(std::max(centres.size(), number + 1));
  cell->GetPoint(centres[number].data());
  for (unsigned char child = 0; !cell->IsLeaf() && child < cell->GetNumberOfChildren(); ++child)
  {
    cell->ToChild(child);
    AddCentres(cell, centres);
    cell->ToParent();
  }
}

/// Returns the cells, both those that are refined and their parts.
Places CentresOf(vtkHyperTreeGrid* trees)
{
  auto centres = std::make_shared<std::vector<std::array<double, 3>>>();
  vtkHyperTreeGrid::vtkHyperTreeGridIterator tree;
  trees->InitializeTreeIterator(tree);
  vtkNew<vtkHyperTreeGridNonOrientedGeometryCursor> cell;
  vtkIdType number = 0;
  while (tree.GetNextTree(number))
  {
    trees->InitializeNonOrientedGeometryCursor(cell, number);
    AddCentres(cell, *centres);
  }
  return { trees->GetCellData(), vtkIdType(centres->size()),
    [centres](vtkIdType index, double position[3])
    {
      const std::array<double, 3>& centre = (*centres)[std::size_t(index)];
      std::copy(centre.begin(), centre.end(), position);
    } };
}

/// Returns the places of a data set, or those of all data sets of a collection.
std::vector<Places> PlacesOf(vtkDataObject* data)
{
  std::vector<Places> all;
  ForObjectsOf(data,
    [&all](vtkDataObject* object)
    {
      if (auto* trees = vtkHyperTreeGrid::SafeDownCast(object))
      {
        all.push_back(CentresOf(trees));
      }
      else if (auto* points = vtkDataSet::SafeDownCast(object);
               points && points->GetNumberOfCells() > 0)
      {
        all.push_back(PointsIn(points));
      }
    });
  return all;
}

void AddInterpolated(vtkImageData* image, vtkFloatArray* values, const Places& places)
{
  const int* points = image->GetDimensions();
  const auto there = NewArray<vtkFloatArray>(values->GetName(), places.count);
  ForOnAllCores(places.count,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType number = begin; number < end; ++number)
      {
        double position[3];
        places.find(number, position);
        const PlaceInImage place(image, position);
        there->SetValue(
          number, static_cast<float>(place.Interpolate(values->GetPointer(0), points)));
      }
    });
  places.attributes->AddArray(there);
}

/// Returns the arrays of one number per point that a result has in addition to its image.
std::vector<SampledArray> NewArrays(vtkImageData* image, vtkImageData* result)
{
  std::vector<SampledArray> arrays;
  vtkPointData* points = result->GetPointData();
  for (int i = 0; i < points->GetNumberOfArrays(); ++i)
  {
    auto* values = vtkFloatArray::SafeDownCast(points->GetArray(i));
    const bool isNew = values && values != image->GetPointData()->GetArray(values->GetName());
    if (isNew && values->GetNumberOfComponents() == 1 && values->GetNumberOfTuples() > 0)
    {
      arrays.push_back({ values->GetName(), VTK_FLOAT });
    }
  }
  return arrays;
}

/// Returns the arrays of a result at the points round some data. The result is a piece of an image
/// of the whole extent; other ranks have the other pieces. Collective.
vtkSmartPointer<vtkImageData> Around(const std::vector<Leaf>& data, vtkImageData* result,
  const std::array<int, 6>& wholeExtent, const std::vector<SampledArray>& arrays,
  const Communicator& ranks)
{
  Lattice whole;
  std::copy_n(result->GetOrigin(), 3, whole.origin.begin());
  std::copy_n(result->GetSpacing(), 3, whole.spacing.begin());
  whole.extent = wholeExtent;
  std::array<int, 6> extent;
  std::copy_n(result->GetExtent(), 6, extent.begin());
  LatticeSamples here(whole.Within(extent), arrays);
  here.Use(result->GetPointData());
  const Lattice part = whole.Around(data);
  const LatticeSamples there = here.Shared(ranks, part);
  auto around = vtkSmartPointer<vtkImageData>::New();
  around->SetOrigin(whole.origin.data());
  around->SetSpacing(whole.spacing.data());
  around->SetExtent(const_cast<int*>(part.extent.data()));
  for (const vtkSmartPointer<vtkDataArray>& values : there.Values())
  {
    around->GetPointData()->AddArray(values);
  }
  return around;
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

void BringBack(const SampledData& sampled, vtkImageData* result, vtkDataObject* data,
  vtkDataObject* output, const Communicator& ranks)
{
  CopyWithLeaves(data, output);
  const std::vector<SampledArray> arrays =
    OfFirstThatHasAny(ranks, NewArrays(sampled.image, result));
  vtkSmartPointer<vtkImageData> around = result;
  if (!ranks.IsAlone())
  {
    around = Around(LeavesOf(data), result, sampled.extent, arrays, ranks);
  }
  for (const Places& places : PlacesOf(output))
  {
    for (const SampledArray& array : arrays)
    {
      auto* values =
        vtkFloatArray::SafeDownCast(around->GetPointData()->GetArray(array.name.c_str()));
      AddInterpolated(around, values, places);
    }
  }
  for (int i = 0; i < result->GetFieldData()->GetNumberOfArrays(); ++i)
  {
    output->GetFieldData()->AddArray(result->GetFieldData()->GetAbstractArray(i));
  }
  AddValue<vtkStringArray>("SampledAt", sampled.text, output->GetFieldData());
}
}
