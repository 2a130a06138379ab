// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidViewpoints.h"

#include "LimpidDataArray.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkPVDataInformation.h"
#include "vtkPointData.h"
#include "vtkSMSourceProxy.h"
#include "vtkSmartPointer.h"

namespace
{
const unsigned int VIEWPOINTS = 1; // output port

// The data of an output, null if it has none.
vtkSmartPointer<vtkDataSet> Bring(vtkSMSourceProxy* source, unsigned int port, double time)
{
  const int type = source->GetDataInformation(port)->GetDataSetType();
  return vtkDataSet::SafeDownCast(BringToClient(source, port, type, time));
}

// Tuples of an array, zeros where there is none.
class Tuples
{
public:
  Tuples(vtkFieldData* arrays, const std::string& name)
    : Array(arrays->GetArray(name.c_str()))
  {
  }

  std::array<double, 3> Vector(vtkIdType tuple) const
  {
    std::array<double, 3> vector{};
    if (this->Array && this->Array->GetNumberOfComponents() == 3 && this->Has(tuple))
    {
      this->Array->GetTuple(tuple, vector.data());
    }
    return vector;
  }

  double Number(vtkIdType tuple) const
  {
    return this->Array && this->Has(tuple) ? this->Array->GetComponent(tuple, 0) : 0.0;
  }

private:
  bool Has(vtkIdType tuple) const { return tuple < this->Array->GetNumberOfTuples(); }

  vtkDataArray* Array;
};

// What all views of a search have in common.
LimpidViewpoint CommonOf(vtkFieldData* fields)
{
  LimpidViewpoint view{};
  view.FocalPoint = Tuples(fields, "CameraFocalPoint").Vector(0);
  view.ViewAngle = Tuples(fields, "CameraViewAngle").Number(0);
  view.ParallelProjection = Tuples(fields, "CameraParallelProjection").Number(0) != 0;
  view.ParallelScale = Tuples(fields, "CameraParallelScale").Number(0);
  return view;
}

// A tuple of point data, or with a prefix, of field data, on top of what is common.
LimpidViewpoint ViewOf(
  const LimpidViewpoint& common, vtkFieldData* arrays, const std::string& prefix, vtkIdType tuple)
{
  LimpidViewpoint view = common;
  view.Position = Tuples(arrays, prefix + "CameraPosition").Vector(tuple);
  view.ViewUp = Tuples(arrays, prefix + "CameraViewUp").Vector(tuple);
  view.VisibleFraction = Tuples(arrays, prefix + "VisibleFraction").Number(tuple);
  return view;
}
}

LimpidViewpoints FindViewpoints(vtkSMSourceProxy* search, double time)
{
  LimpidViewpoints found;
  const auto data = Bring(search, VIEWPOINTS, time);
  if (!data || data->GetNumberOfPoints() == 0)
  {
    return found;
  }
  vtkFieldData* fields = data->GetFieldData();
  const LimpidViewpoint common = CommonOf(fields);
  for (vtkIdType point = 0; point < data->GetNumberOfPoints(); ++point)
  {
    found.Ranked.push_back(ViewOf(common, data->GetPointData(), "", point));
  }
  if (fields->GetArray("WorstCameraPosition"))
  {
    found.Worst = ViewOf(common, fields, "Worst", 0);
  }
  return found;
}

bool HasSelection(vtkSMSourceProxy* search)
{
  for (unsigned int port = 0; port < search->GetNumberOfOutputPorts(); ++port)
  {
    if (search->GetSelectionInput(port))
    {
      return true;
    }
  }
  return false;
}

std::optional<LimpidViewpoint> FindBestSelected(vtkSMSourceProxy* search, double time)
{
  std::optional<LimpidViewpoint> best;
  double bestScore = 0;
  const auto summary = Bring(search, VIEWPOINTS, time);
  for (unsigned int port = 0; summary && port < search->GetNumberOfOutputPorts(); ++port)
  {
    vtkSMSourceProxy* selected =
      search->GetSelectionInput(port) ? search->GetSelectionOutput(port) : nullptr;
    if (!selected)
    {
      continue;
    }
    selected->UpdatePipeline(time);
    const auto data = Bring(selected, 0, time);
    for (vtkIdType point = 0; data && point < data->GetNumberOfPoints(); ++point)
    {
      const double score = Tuples(data->GetPointData(), "VisibilityScore").Number(point);
      if (!best || score > bestScore)
      {
        best = ViewOf(CommonOf(summary->GetFieldData()), data->GetPointData(), "", point);
        bestScore = score;
      }
    }
  }
  return best;
}
