// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_Abort_h
#define limpid_Abort_h

#include "vtkAlgorithm.h"
#include "vtkVersionMacros.h"

#include <functional>

namespace limpid
{
/// Whether the user wants to stop. Call it from the thread of the request.
inline bool IsAborted(vtkAlgorithm* algorithm)
{
// vtkAlgorithm::CheckAbort came between VTK's releases 9.2 and 9.3; ParaView 5.11 has it.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20230111)
  const bool aborted = algorithm->CheckAbort();
  // The executive would empty the output, but we leave a valid one.
  algorithm->SetAbortOutput(false);
  return aborted;
#else
  return algorithm->GetAbortExecute() != 0;
#endif
}

/// What an Interruptible asks in a request: observers of the progress hear that time goes by, and
/// may abort.
inline std::function<bool()> GoOn(vtkAlgorithm* algorithm)
{
  return [algorithm]()
  {
    algorithm->UpdateProgress(algorithm->GetProgress());
    return !IsAborted(algorithm);
  };
}
}

#endif
