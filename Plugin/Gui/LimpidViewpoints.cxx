// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidViewpoints.h"

#include "LimpidDataArray.h"
#include "LimpidTuples.h"

#include "vtkDataSet.h"
#include "vtkPVDataInformation.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSourceProxy.h"
#include "vtkSmartPointer.h"

namespace
{
const unsigned int VIEWPOINTS = 1; // output port

// Returns the data of an output, null if it has none.
vtkSmartPointer<vtkDataSet> Bring(vtkSMSourceProxy* source, unsigned int port, double time)
{
  const int type = source->GetDataInformation(port)->GetDataSetType();
  return vtkDataSet::SafeDownCast(BringToClient(source, port, type, time));
}

// Returns what all views of a search have in common; for a parallel projection, this includes the
// distance.
LimpidViewpoint CommonOf(vtkSMSourceProxy* search, vtkDataSet* viewpoints)
{
  vtkFieldData* fields = viewpoints->GetFieldData();
  LimpidViewpoint view;
  view.Orbit.centre = LimpidTuples(fields, "CameraFocalPoint").Vector(0);
  view.Orbit.up = LimpidTuples(fields, "CameraUpAxis").Vector(0);
  view.Orbit.viewAngle = LimpidTuples(fields, "CameraViewAngle").Number(0);
  view.Orbit.parallel = LimpidTuples(fields, "CameraParallelProjection").Number(0) != 0;
  const limpid::Vec3 position =
    LimpidTuples(viewpoints->GetPointData(), "CameraPosition").Vector(0);
  view.Orbit.distance = glm::distance(position, view.Orbit.centre);
  view.Corners = LimpidTuples(fields, "ImageCorners").Vectors(0);
  const bool aimsAtCentre = vtkSMPropertyHelper(search, "UseFocalPoint").GetAsInt() != 0;
  view.Aim = aimsAtCentre ? limpid::Aim::Centre : limpid::Aim::Box;
  return view;
}

// Returns the viewpoint of a point; `common`: parameters of all views.
LimpidViewpoint ViewOf(const LimpidViewpoint& common, vtkFieldData* arrays, vtkIdType point)
{
  LimpidViewpoint view = common;
  view.Direction = LimpidTuples(arrays, "ViewDirection").Vector(point);
  view.VisibleFraction = LimpidTuples(arrays, "VisibleFraction").Number(point);
  return view;
}

LimpidViewpoint WorstOf(const LimpidViewpoint& common, vtkFieldData* fields)
{
  LimpidViewpoint view = common;
  view.Direction =
    glm::normalize(LimpidTuples(fields, "WorstCameraPosition").Vector(0) - common.Orbit.centre);
  view.VisibleFraction = LimpidTuples(fields, "WorstVisibleFraction").Number(0);
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
  const LimpidViewpoint common = CommonOf(search, data);
  for (vtkIdType point = 0; point < data->GetNumberOfPoints(); ++point)
  {
    found.Ranked.push_back(ViewOf(common, data->GetPointData(), point));
  }
  if (data->GetFieldData()->GetArray("WorstCameraPosition"))
  {
    found.Worst = WorstOf(common, data->GetFieldData());
  }
  return found;
}

limpid::Camera CameraOf(const LimpidViewpoint& viewpoint, vtkSMRenderViewProxy* view)
{
  limpid::Orbit orbit = viewpoint.Orbit;
  orbit.aspect = view->GetRenderer()->GetTiledAspectRatio();
  return limpid::FittedCamera(orbit, viewpoint.Corners, viewpoint.Direction, viewpoint.Aim);
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
  const auto viewpoints = Bring(search, VIEWPOINTS, time);
  for (unsigned int port = 0; viewpoints && port < search->GetNumberOfOutputPorts(); ++port)
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
      const double score = LimpidTuples(data->GetPointData(), "VisibilityScore").Number(point);
      if (!best || score > bestScore)
      {
        best = ViewOf(CommonOf(search, viewpoints), data->GetPointData(), point);
        bestScore = score;
      }
    }
  }
  return best;
}
