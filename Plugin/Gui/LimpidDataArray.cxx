// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidDataArray.h"

#include "ImportancePoints.h"

#include "pqUndoStack.h"
#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>

namespace
{
// Number of bins of the histogram that suggests important values.
const int FINE = 4096;

vtkPVArrayInformation* InformationOf(const LimpidDataArray& array)
{
  return array.Source ? array.Source->GetDataInformation(array.Port)
                          ->GetArrayInformation(array.Name.c_str(), array.Association)
                      : nullptr;
}

vtkSmartPointer<vtkSMSourceProxy> NewFilter(vtkSMProxy* neighbour, const char* name)
{
  vtkSmartPointer<vtkSMSourceProxy> filter;
  filter.TakeReference(
    vtkSMSourceProxy::SafeDownCast(neighbour->GetSessionProxyManager()->NewProxy("filters", name)));
  return filter;
}

// Returns extents and counts of values in equal bins of a range, over the data of all ranks.
vtkSmartPointer<vtkTable> CountValues(
  const LimpidDataArray& array, const std::array<double, 2>& range, int bins)
{
  SCOPED_UNDO_EXCLUDE();
  const int components = InformationOf(array)->GetNumberOfComponents();
  const int magnitude = components > 1 ? components : 0; // that filter's number of the magnitude
  const auto counter = NewFilter(array.Source, "ExtractHistogram");
  vtkSMPropertyHelper(counter, "Input").Set(array.Source, array.Port);
  vtkSMPropertyHelper(counter, "SelectInputArray")
    .SetInputArrayToProcess(array.Association, array.Name.c_str());
  vtkSMPropertyHelper(counter, "Component").Set(array.Component < 0 ? magnitude : array.Component);
  vtkSMPropertyHelper(counter, "BinCount").Set(bins);
  vtkSMPropertyHelper(counter, "UseCustomBinRanges").Set(1);
  vtkSMPropertyHelper(counter, "CustomBinRanges").Set(range.data(), 2);
  counter->UpdateVTKObjects();

  const auto reducer = NewFilter(array.Source, "ReductionFilter");
  vtkSMPropertyHelper(reducer, "Input").Set(counter);
  vtkSMPropertyHelper(reducer, "PostGatherHelperName").Set("vtkPVMergeTables");
  reducer->UpdateVTKObjects();
  const auto counts = BringToClient(reducer, 0, VTK_TABLE, std::nullopt);
  return vtkTable::SafeDownCast(counts);
}
}

vtkSmartPointer<vtkDataObject> BringToClient(
  vtkSMSourceProxy* source, unsigned int port, int type, std::optional<double> time)
{
  SCOPED_UNDO_EXCLUDE(); // otherwise every helper filter would be an undo step
  const auto mover = NewFilter(source, "ClientServerMoveData");
  vtkSMPropertyHelper(mover, "Input").Set(source, port);
  vtkSMPropertyHelper(mover, "OutputDataType").Set(type);
  mover->UpdateVTKObjects();
  if (time)
  {
    mover->UpdatePipeline(*time);
  }
  else
  {
    mover->UpdatePipeline();
  }
  auto* algorithm = vtkAlgorithm::SafeDownCast(mover->GetClientSideObject());
  return algorithm ? algorithm->GetOutputDataObject(0) : nullptr;
}

std::array<double, 2> LimpidDataArray::Range() const
{
  std::array<double, 2> range{ 0, -1 };
  if (vtkPVArrayInformation* information = InformationOf(*this))
  {
    const bool isScalar = information->GetNumberOfComponents() == 1;
    information->GetComponentFiniteRange(isScalar ? 0 : this->Component, range.data());
  }
  return range;
}

vtkSmartPointer<vtkTable> LimpidDataArray::Histogram(
  const std::array<double, 2>& range, int bins) const
{
  vtkSmartPointer<vtkTable> counts;
  if (InformationOf(*this) && range[0] < range[1])
  {
    counts = CountValues(*this, range, bins);
  }
  if (!counts || counts->GetNumberOfColumns() < 2)
  {
    return nullptr;
  }
  vtkNew<vtkDoubleArray> heights;
  heights->SetName("bin_heights");
  for (vtkIdType bin = 0; bin < counts->GetNumberOfRows(); ++bin)
  {
    heights->InsertNextValue(std::log1p(counts->GetValue(bin, 1).ToDouble()));
  }
  auto histogram = vtkSmartPointer<vtkTable>::New();
  histogram->AddColumn(counts->GetColumn(0));
  histogram->AddColumn(heights);
  return histogram;
}

std::vector<double> LimpidDataArray::SuggestedImportance() const
{
  const std::array<double, 2> range = this->Range();
  const bool isImportance = range[0] >= 0 && range[1] <= 1;
  const auto counts =
    range[0] < range[1] && !isImportance ? CountValues(*this, range, FINE) : nullptr;
  if (!counts || counts->GetNumberOfColumns() < 2)
  {
    return {};
  }
  const auto countIn = [&](vtkIdType bin) { return counts->GetValue(bin, 1).ToDouble(); };
  double all = 0;
  for (vtkIdType bin = 0; bin < counts->GetNumberOfRows(); ++bin)
  {
    all += countIn(bin);
  }
  // The upper ends of the bins in which the cumulative shares are reached. If both are in one bin,
  // the first is the lower end of that bin.
  const double width = (range[1] - range[0]) / FINE;
  std::array<double, 2> ends{ range[1], range[1] };
  double reached = all;
  for (vtkIdType bin = counts->GetNumberOfRows() - 1; bin >= 0; --bin)
  {
    const double end = range[0] + width * double(bin + 1);
    ends[0] = reached >= limpid::ImportanceBegins * all ? std::min(end, ends[1] - width) : ends[0];
    ends[1] = reached >= limpid::ImportanceIsFull * all ? end : ends[1];
    reached -= countIn(bin);
  }
  return { range[0], ends[0], ends[1], range[1] };
}

namespace
{
// Returns the first of some properties of a proxy whose array the input has, as its panel shows it.
LimpidDataArray ChosenArray(vtkSMProxy* proxy, const std::vector<const char*>& properties)
{
  LimpidDataArray array;
  vtkSMPropertyHelper input(proxy, "Input", /*quiet=*/true);
  auto* source =
    input.GetNumberOfElements() > 0 ? vtkSMSourceProxy::SafeDownCast(input.GetAsProxy()) : nullptr;
  array.Port = source ? input.GetOutputPort() : 0;
  for (const char* name : properties)
  {
    vtkSMPropertyHelper chosen(proxy, name, /*quiet=*/true);
    chosen.SetUseUnchecked(true);
    const char* text = chosen.GetNumberOfElements() == 5 ? chosen.GetAsString(4) : nullptr;
    array.Name = text ? text : "";
    array.Association = text ? chosen.GetAsInt(3) : 0;
    array.Source = source;
    if (InformationOf(array))
    {
      return array;
    }
  }
  array.Source = nullptr;
  return array;
}
}

LimpidDataArray ImportanceArrayOf(vtkSMProxy* proxy)
{
  if (!proxy->GetProperty("ImportanceArray"))
  {
    return {};
  }
  // The second is a property of displays, the third of filters.
  LimpidDataArray array =
    ChosenArray(proxy, { "ImportanceArray", "ColorArrayName", "ScalarArray" });
  if (array)
  {
    vtkSMPropertyHelper component(proxy, "ImportanceComponent");
    component.SetUseUnchecked(true);
    array.Component = component.GetAsInt();
  }
  return array;
}

LimpidDataArray StructureArrayOf(vtkSMProxy* proxy)
{
  return ChosenArray(proxy, { "StructureArray" });
}
