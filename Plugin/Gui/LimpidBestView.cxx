// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidBestView.h"

#include "LimpidOptimizedVolumes.h"
#include "LimpidTakeOver.h"
#include "LimpidViewpoints.h"
#include "pqActiveObjects.h"
#include "pqDataRepresentation.h"
#include "pqRenderView.h"
#include "pqUndoStack.h"
#include "vtkCommand.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkSMParaViewPipelineController.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"

#include <QApplication>
#include <QIcon>

namespace
{
// Number of directions of the icosphere that are searched. Starting from the best of these, the
// search finds views as good as from the best of 642, in a third of the time (5 s instead of 13.5 s
// for 8.4 M voxels on two cores).
const int DIRECTIONS = 162;

void Set(vtkSMProxy* view, const char* name, const limpid::Vec3& value)
{
  vtkSMPropertyHelper(view, name).Set(&value.x, 3);
  // The trace must include unchanged values as well, since it does not record moves by the mouse.
  view->GetProperty(name)->Modified();
}

void Set(vtkSMProxy* view, const char* name, double value)
{
  vtkSMPropertyHelper(view, name).Set(value);
  view->GetProperty(name)->Modified();
}

// Returns the display of an optimised volume in a view: the active one, or else the first.
vtkSMProxy* ChooseDisplay(vtkSMRenderViewProxy* view)
{
  const pqDataRepresentation* active = pqActiveObjects::instance().activeRepresentation();
  vtkSMProxy* first = nullptr;
  for (vtkSMProxy* volume : VisibleOptimizedVolumes(view))
  {
    vtkSMProxy* display = volume->GetTrueParentProxy();
    if (active && display == active->getProxy())
    {
      return display;
    }
    first = first ? first : display;
  }
  return first;
}

// Runs a search with the settings of a display. `structures`: in place of its property Structures;
// empty: those of the display.
vtkSmartPointer<vtkSMSourceProxy> Search(
  vtkSMProxy* display, vtkSMRenderViewProxy* view, const QVariantList& structures)
{
  SCOPED_UNDO_EXCLUDE();
  vtkSMPropertyHelper input(display, "Input");
  auto search = NewHiddenFilter("ViewpointSearch", input.GetAsProxy(), input.GetOutputPort());
  vtkSMPropertyHelper(search, "NumberOfDirections").Set(DIRECTIONS);
  TakeOverDisplay(search, display, view);
  if (!structures.isEmpty())
  {
    vtkSMPropertyHelper rows(search, "Structures");
    rows.SetNumberOfElements(static_cast<unsigned>(structures.size()));
    for (int i = 0; i < structures.size(); ++i)
    {
      rows.Set(static_cast<unsigned>(i), structures[i].toString().toUtf8().data());
    }
    search->UpdateVTKObjects();
  }
  QApplication::setOverrideCursor(Qt::WaitCursor);
  search->UpdatePipeline(vtkSMPropertyHelper(view, "ViewTime").GetAsDouble());
  QApplication::restoreOverrideCursor();
  return search;
}

// Gives a view the camera of the best viewpoint that a search found, if any.
void LookFromBest(vtkSMSourceProxy* search, pqRenderView* view)
{
  const double time = vtkSMPropertyHelper(view->getProxy(), "ViewTime").GetAsDouble();
  const LimpidViewpoints found = FindViewpoints(search, time);
  if (!found.Ranked.empty())
  {
    LookFrom(
      found.Ranked.front(), view, QCoreApplication::translate("LimpidBestView", " best viewpoint"));
  }
}
}

vtkSmartPointer<vtkSMSourceProxy> NewHiddenFilter(
  const char* name, vtkSMProxy* input, unsigned int port)
{
  SCOPED_UNDO_EXCLUDE();
  vtkSmartPointer<vtkSMSourceProxy> filter;
  filter.TakeReference(
    vtkSMSourceProxy::SafeDownCast(input->GetSessionProxyManager()->NewProxy("filters", name)));
  vtkNew<vtkSMParaViewPipelineController> controller;
  controller->PreInitializeProxy(filter);
  vtkSMPropertyHelper(filter, "Input").Set(input, port);
  controller->PostInitializeProxy(filter);
  return filter;
}

limpid::Camera PresentCamera(vtkSMRenderViewProxy* view)
{
  view->SynchronizeCameraProperties();
  limpid::Camera camera;
  vtkSMPropertyHelper(view, "CameraPosition").Get(&camera.position.x, 3);
  vtkSMPropertyHelper(view, "CameraFocalPoint").Get(&camera.focalPoint.x, 3);
  vtkSMPropertyHelper(view, "CameraViewUp").Get(&camera.viewUp.x, 3);
  camera.viewAngle = vtkSMPropertyHelper(view, "CameraViewAngle").GetAsDouble();
  camera.parallel = vtkSMPropertyHelper(view, "CameraParallelProjection").GetAsInt() != 0;
  camera.parallelScale = vtkSMPropertyHelper(view, "CameraParallelScale").GetAsDouble();
  return camera;
}

void SetCamera(vtkSMRenderViewProxy* view, const limpid::Camera& camera)
{
  Set(view, "CameraPosition", camera.position);
  Set(view, "CameraFocalPoint", camera.focalPoint);
  Set(view, "CameraViewUp", camera.viewUp);
  Set(view, "CameraViewAngle", camera.viewAngle);
  vtkSMPropertyHelper(view, "CameraParallelProjection").Set(camera.parallel ? 1 : 0);
  if (camera.parallel)
  {
    Set(view, "CameraParallelScale", camera.parallelScale);
  }
  view->UpdateVTKObjects();
}

void LookFrom(const limpid::Camera& camera, const limpid::Vec3& centre, pqRenderView* view,
  const QString& comment)
{
  SCOPED_UNDO_EXCLUDE(); // "Camera Undo" has a stack of its own
  vtkSMRenderViewProxy* proxy = view->getRenderViewProxy();
  proxy->SynchronizeCameraProperties();
  {
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", proxy).arg("comment", comment.toUtf8().data());
    proxy->GetInteractor()->InvokeEvent(vtkCommand::StartInteractionEvent);
    SetCamera(proxy, camera);
    if (view->getResetCenterWithCamera())
    {
      Set(proxy, "CenterOfRotation", centre);
      proxy->UpdateVTKObjects();
    }
    proxy->GetInteractor()->InvokeEvent(vtkCommand::EndInteractionEvent);
  }
  view->render();
}

void LookFrom(const LimpidViewpoint& viewpoint, pqRenderView* view, const QString& comment)
{
  LookFrom(CameraOf(viewpoint, view->getRenderViewProxy()), viewpoint.Orbit.centre, view, comment);
}

vtkSmartPointer<vtkSMSourceProxy> SearchActiveVolume()
{
  vtkSMRenderViewProxy* view = ActiveRenderView();
  vtkSMProxy* display = view ? ChooseDisplay(view) : nullptr;
  return display ? Search(display, view, {}) : nullptr;
}

void FindBestView()
{
  if (const vtkSmartPointer<vtkSMSourceProxy> search = SearchActiveVolume())
  {
    LookFromBest(search, qobject_cast<pqRenderView*>(pqActiveObjects::instance().activeView()));
  }
}

void FindBestViewOf(vtkSMProxy* display, pqRenderView* view, const QVariantList& structures)
{
  LookFromBest(Search(display, view->getRenderViewProxy(), structures), view);
}

QIcon BestViewIcon()
{
  return QIcon(":/Limpid/Icons/FindBestView.svg");
}

QString BestViewToolTip()
{
  return QCoreApplication::translate("LimpidBestView",
    "Look from where the most of the important structures can be seen. Camera Undo goes back.");
}
