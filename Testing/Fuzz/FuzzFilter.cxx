// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// For any image and properties, vtkExtinctionOptimizer either reports an error and has no output,
// or its fields are numbers within their bounds. It never changes its input.

#include "Invented.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkExtinctionOptimizer.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkPointData.h"
#include "vtkType.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVisibilitySettings.h"

#include <cmath>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
/// An array of any type with as many tuples as it should have, or almost.
void AddField(Invented& make, const char* name, vtkImageData* image)
{
  constexpr int types[] = { VTK_FLOAT, VTK_DOUBLE, VTK_UNSIGNED_CHAR, VTK_SHORT, VTK_INT,
    VTK_LONG_LONG };
  const bool onCells = make.Integer(0, 3) == 0;
  vtkIdType tuples = onCells ? image->GetNumberOfCells() : image->GetNumberOfPoints();
  tuples = std::max<vtkIdType>(0, tuples + (make.Integer(0, 15) == 0 ? make.Integer(-3, 3) : 0));
  auto array =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(types[make.Integer(0, 5)]));
  array->SetName(name);
  array->SetNumberOfComponents(make.Integer(0, 7) == 0 ? make.Integer(1, 4) : 1);
  array->SetNumberOfTuples(tuples);
  const bool real = array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
  for (vtkIdType value = 0; value < array->GetNumberOfValues(); ++value)
  {
    const double number = real ? make.Number(0, 1) : make.Integer(0, 200);
    array->SetComponent(value / array->GetNumberOfComponents(),
      static_cast<int>(value % array->GetNumberOfComponents()), number);
  }
  (onCells ? static_cast<vtkFieldData*>(image->GetCellData()) : image->GetPointData())
    ->AddArray(array);
}

void AddGhosts(Invented& make, vtkDataSetAttributes* data, vtkIdType count)
{
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName(vtkDataSetAttributes::GhostArrayName());
  flags->SetNumberOfTuples(
    std::max<vtkIdType>(0, count + (make.Integer(0, 7) == 0 ? make.Integer(-5, 5) : 0)));
  for (vtkIdType i = 0; i < flags->GetNumberOfTuples(); ++i)
  {
    flags->SetValue(
      i, make.Integer(0, 3) == 0 ? static_cast<unsigned char>(make.Integer(0, 255)) : 0);
  }
  data->AddArray(flags);
}

void SetProperties(Invented& make, vtkExtinctionOptimizer* filter)
{
  filter->SetExtinctionSource(make.Integer(-1, 3));
  filter->SetScalarOpacityUnitDistance(make.Number(0.01, 3));
  filter->SetAutomaticPlacement(make.Chance());
  filter->SetCameraPosition(make.Number(-9, 9), make.Number(-9, 9), make.Number(-9, 9));
  filter->SetCameraFocalPoint(make.Number(-3, 3), make.Number(-3, 3), make.Number(-3, 3));
  filter->SetCameraViewAngle(make.Number(1, 179));
  filter->SetCameraParallelProjection(make.Chance());
  filter->SetCameraParallelScale(make.Number(0.1, 9));
  filter->SetCameraAspectRatio(make.Number(0.1, 9));
  filter->SetWarmStart(make.Chance());
  vtkVisibilitySettings* settings = filter->GetVisibilitySettings();
  settings->SetScalarComponent(make.Integer(-1, 4));
  settings->SetImportanceComponent(make.Integer(-1, 4));
  settings->SetRegularizationWeight(make.Number(1e-6, 1));
  settings->SetViewWeight(make.Number(0, 100));
  settings->SetLightWeight(make.Number(0, 10));
  settings->SetLightType(make.Integer(-1, 4));
  settings->SetLightPosition(make.Number(-9, 9), make.Number(-9, 9), make.Number(-9, 9));
  settings->SetMode(make.Integer(-1, 2));
  settings->SetSolver(make.Integer(-1, 2));
  settings->SetMaximumIterations(make.Integer(-1, 3));
  settings->SetIterationsPerLevel(make.Integer(0, 2), make.Integer(0, 2), make.Integer(-1, 2));
  settings->SetRayDensity(make.Number(0.5, 2));
  settings->SetSkipUnneeded(make.Chance());
  settings->SetRestrictToView(make.Chance());
  settings->SetProtectImportance(make.Number(-0.1, 1.1));
  settings->SetClearingThreshold(make.Chance() ? make.Number(-0.1, 2) : 0);
  settings->SetEmphasis(make.Number(-0.1, 1.1));
  settings->SetImportanceSmoothing(make.Chance() ? 1 : 0);
  settings->SetSmoothness(make.Number(-0.1, 1));
  settings->SetTemporalCoherence(make.Number(-0.1, 1));
  settings->SetViews(make.Chance() ? make.Integer(-1, 3) : 0);
  settings->SetNumberOfViews(make.Integer(0, 3));
  settings->SetEyeAngle(make.Number(-1, 10));
  settings->SetBackend(make.Integer(0, 1) == 0 ? 1 : make.Integer(-1, 3));
}

void RequireNumbers(vtkImageData* output, const char* name, double high)
{
  vtkDataArray* array = output->GetPointData()->GetArray(name);
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    const double value = array->GetComponent(i, 0);
    Demand(value >= 0 && value <= high, name);
  }
}

std::vector<double> FlagsOf(vtkDataSetAttributes* data)
{
  std::vector<double> values;
  vtkDataArray* flags = data->GetArray(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType i = 0; flags && i < flags->GetNumberOfTuples(); ++i)
  {
    values.push_back(flags->GetComponent(i, 0));
  }
  return values;
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count)
{
  vtkObject::GlobalWarningDisplayOff(); // messages are welcome
  Invented make(bytes, count);
  vtkNew<vtkImageData> image;
  image->SetExtent(
    make.Integer(-2, 1), make.Integer(-2, 6), 0, make.Integer(-1, 6), 3, make.Integer(2, 8));
  image->SetSpacing(make.Number(0.1, 3), make.Number(0.1, 3), make.Number(0.1, 3));
  image->SetOrigin(make.Number(-9, 9), make.Number(-9, 9), make.Number(-9, 9));
  AddField(make, "density", image);
  AddField(make, "what matters", image);
  if (make.Chance())
  {
    AddGhosts(make, image->GetPointData(), image->GetNumberOfPoints());
  }
  if (make.Chance())
  {
    AddGhosts(make, image->GetCellData(), image->GetNumberOfCells());
  }
  const std::vector<double> points = FlagsOf(image->GetPointData());
  const std::vector<double> cells = FlagsOf(image->GetCellData());
  vtkNew<vtkExtinctionOptimizer> filter;
  filter->SetInputData(image);
  const int association = vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS;
  filter->SetInputArrayToProcess(0, 0, 0, association, "density");
  filter->SetInputArrayToProcess(1, 0, 0, association, "what matters");
  SetProperties(make, filter);
  filter->Update();
  auto* output = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  RequireNumbers(output, "Extinction", 1e300);
  RequireNumbers(output, "Opacity", 1);
  RequireNumbers(output, "Transmittance", 1);
  RequireNumbers(output, "LightTransmittance", 1);
  Demand(points == FlagsOf(image->GetPointData()) && cells == FlagsOf(image->GetCellData()),
    "the input stays as it is");
  return 0;
}
