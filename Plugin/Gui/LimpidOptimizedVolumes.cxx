// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidOptimizedVolumes.h"

#include "pqActiveObjects.h"
#include "pqRenderView.h"
#include "vtkClientServerStream.h"
#include "vtkPVSession.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSession.h"

#include <cstring>

vtkSMRenderViewProxy* ActiveRenderView()
{
  auto* view = qobject_cast<pqRenderView*>(pqActiveObjects::instance().activeView());
  return view ? view->getRenderViewProxy() : nullptr;
}

bool IsOptimizedVolume(vtkSMProxy* display)
{
  if (!display->GetProperty("Converged") || !display->GetProperty("Representation"))
  {
    return false;
  }
  const char* type = vtkSMPropertyHelper(display, "Representation").GetAsString();
  return type && std::strcmp(type, "Optimized Volume") == 0; // text in LimpidRepresentations.xml
}

std::vector<vtkSMProxy*> VisibleOptimizedVolumes(vtkSMViewProxy* view)
{
  std::vector<vtkSMProxy*> volumes;
  if (!view)
  {
    return volumes;
  }
  vtkSMPropertyHelper displays(view, "Representations");
  for (unsigned int i = 0; i < displays.GetNumberOfElements(); ++i)
  {
    vtkSMProxy* display = displays.GetAsProxy(i);
    if (display && IsOptimizedVolume(display) &&
      vtkSMPropertyHelper(display, "Visibility").GetAsInt() != 0)
    {
      volumes.push_back(display->GetProperty("Converged")->GetParent()); // of a sub-proxy
    }
  }
  return volumes;
}

void SetStillRenders(vtkSMProxy* volume, StillRenders how)
{
  vtkClientServerStream stream;
  stream << vtkClientServerStream::Invoke << VTKOBJECT(volume) << "SetProgressiveStill"
         << (how == StillRenders::Stepwise ? 1 : 0) << vtkClientServerStream::End;
  stream << vtkClientServerStream::Invoke << VTKOBJECT(volume) << "SetDeferStill"
         << (how == StillRenders::Deferred ? 1 : 0) << vtkClientServerStream::End;
  volume->GetSession()->ExecuteStream(volume->GetLocation(), stream);
}

namespace
{
// Returns the result of a method without arguments on the process that draws. `location`: processes
// on which to call it.
bool Ask(vtkSMProxy* volume, const char* method, vtkTypeUInt32 location, bool otherwise)
{
  vtkClientServerStream stream;
  stream << vtkClientServerStream::Invoke << VTKOBJECT(volume) << method
         << vtkClientServerStream::End;
  vtkSMSession* session = volume->GetSession();
  session->ExecuteStream(location, stream);
  int answer = otherwise ? 1 : 0;
  session->GetLastResult(vtkPVSession::RENDER_SERVER_ROOT).GetArgument(0, 0, &answer);
  return answer != 0;
}
}

bool IsConverged(vtkSMProxy* volume)
{
  return Ask(volume, "GetConverged", vtkPVSession::RENDER_SERVER_ROOT, true);
}

bool AreStructuresMeasured(vtkSMProxy* volume)
{
  return Ask(volume, "GetStructuresMeasured", vtkPVSession::RENDER_SERVER_ROOT, true);
}

void MeasureStructures(vtkSMProxy* volume)
{
  Ask(volume, "MeasureStructures", vtkPVSession::RENDER_SERVER, true);
}

int PickStructure(vtkSMProxy* volume, double x, double y)
{
  vtkClientServerStream stream;
  stream << vtkClientServerStream::Invoke << VTKOBJECT(volume) << "PickStructure" << x << y
         << vtkClientServerStream::End;
  vtkSMSession* session = volume->GetSession();
  session->ExecuteStream(vtkPVSession::RENDER_SERVER_ROOT, stream);
  int row = -1;
  session->GetLastResult(vtkPVSession::RENDER_SERVER_ROOT).GetArgument(0, 0, &row);
  return row;
}

bool PrepareOriginal(vtkSMProxy* volume)
{
  return Ask(volume, "PrepareOriginal", vtkPVSession::RENDER_SERVER, false);
}
