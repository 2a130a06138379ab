// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_Abort_h
#define limpid_Abort_h

#include "vtkAlgorithm.h"
#include "vtkVersionMacros.h"

#include <functional>

namespace limpid
{
/// Returns whether the user wants to stop. Must be called from the thread of the request.
inline bool IsAborted(vtkAlgorithm* algorithm)
{
// vtkAlgorithm::CheckAbort was added between VTK 9.2 and 9.3; ParaView 5.11 has it.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20230111)
  const bool aborted = algorithm->CheckAbort();
  // The executive would empty the output, but it has a valid result.
  algorithm->SetAbortOutput(false);
  return aborted;
#else
  return algorithm->GetAbortExecute() != 0;
#endif
}

/// Returns the function that an Interruptible calls during a request. It invokes progress events,
/// whose observers may abort.
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
