// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_AllCores_h
#define limpid_AllCores_h

#include "vtkSMPTools.h"

#include <cstdlib>
#include <string>

namespace limpid
{
/// vtkSMPTools::For over [0, count) on all cores. vtkSMPTools itself may run on one core only, for
/// instance in Debian's ParaView: unless the user has asked for that, we use its threads.
template <class Body>
void ForOnAllCores(vtkIdType count, const Body& body)
{
  const bool sequential = vtkSMPTools::GetBackend() == std::string("Sequential");
  if (sequential && !std::getenv("VTK_SMP_BACKEND_IN_USE"))
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config{ std::string("STDThread") },
      [count, &body]() { vtkSMPTools::For(0, count, body); });
  }
  else
  {
    vtkSMPTools::For(0, count, body);
  }
}
}

#endif
