// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidOptimizedVolumes.h"

#include "vtkClientServerStream.h"
#include "vtkPVSession.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSession.h"
#include "vtkSMViewProxy.h"

#include <cstring>

namespace
{
// The sub-proxy of a representation that shows an optimised volume, null if it shows none. Names
// are those of LimpidRepresentations.xml.
vtkSMProxy* OptimizedVolumeOf(vtkSMProxy* representation)
{
  vtkSMProperty* converged = representation->GetProperty("Converged"); // a sub-proxy's, exposed
  if (!converged || vtkSMPropertyHelper(representation, "Visibility").GetAsInt() == 0)
  {
    return nullptr;
  }
  const char* type = vtkSMPropertyHelper(representation, "Representation").GetAsString();
  return type && std::strcmp(type, "Optimized Volume") == 0 ? converged->GetParent() : nullptr;
}
}

std::vector<vtkSMProxy*> VisibleOptimizedVolumes(vtkSMViewProxy* view)
{
  std::vector<vtkSMProxy*> volumes;
  vtkSMPropertyHelper representations(view, "Representations");
  for (unsigned int i = 0; i < representations.GetNumberOfElements(); ++i)
  {
    vtkSMProxy* representation = representations.GetAsProxy(i);
    if (vtkSMProxy* volume = representation ? OptimizedVolumeOf(representation) : nullptr)
    {
      volumes.push_back(volume);
    }
  }
  return volumes;
}

void SetProgressiveStill(vtkSMProxy* volume, bool progressive)
{
  vtkClientServerStream stream;
  stream << vtkClientServerStream::Invoke << VTKOBJECT(volume) << "SetProgressiveStill"
         << (progressive ? 1 : 0) << vtkClientServerStream::End;
  volume->GetSession()->ExecuteStream(volume->GetLocation(), stream);
}

bool IsConverged(vtkSMProxy* volume)
{
  vtkClientServerStream stream;
  stream << vtkClientServerStream::Invoke << VTKOBJECT(volume) << "GetConverged"
         << vtkClientServerStream::End;
  vtkSMSession* session = volume->GetSession();
  session->ExecuteStream(vtkPVSession::RENDER_SERVER_ROOT, stream);
  int converged = 1;
  session->GetLastResult(vtkPVSession::RENDER_SERVER_ROOT).GetArgument(0, 0, &converged);
  return converged != 0;
}
