// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Filters on a small phantom, and the bits of what they find.

#ifndef limpid_testing_PhantomFilters_h
#define limpid_testing_PhantomFilters_h

#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkExtinctionOptimizer.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkOcclusionPhantom.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkViewpointSearch.h"

#include <string>
#include <vector>

namespace limpid
{
inline vtkSmartPointer<vtkImageData> Phantom(int resolution, int scene)
{
  vtkNew<vtkOcclusionPhantom> source;
  source->SetResolution(resolution);
  source->SetScene(scene);
  source->Update();
  return source->GetOutput();
}

inline vtkSmartPointer<vtkExtinctionOptimizer> Optimizer(vtkImageData* image)
{
  auto filter = vtkSmartPointer<vtkExtinctionOptimizer>::New();
  filter->SetInputData(image);
  filter->SetExtinctionSource(vtkVisibilityAlgorithm::ARRAY);
  filter->SetMaximumIterations(3);
  return filter;
}

inline vtkSmartPointer<vtkViewpointSearch> Search(vtkImageData* image)
{
  auto filter = vtkSmartPointer<vtkViewpointSearch>::New();
  filter->SetInputData(image);
  filter->SetExtinctionSource(vtkVisibilityAlgorithm::ARRAY);
  filter->SetNumberOfDirections(12);
  filter->SetNumberOfViewpoints(1);
  return filter;
}

/// All values of all point arrays of a filter's first output.
inline std::vector<double> OutcomeOf(vtkAlgorithm* filter)
{
  std::vector<double> values;
  vtkPointData* arrays = vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0))->GetPointData();
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = arrays->GetArray(i);
    for (vtkIdType value = 0; value < array->GetNumberOfValues(); ++value)
    {
      values.push_back(array->GetVariantValue(value).ToDouble());
    }
  }
  return values;
}
}

#endif
