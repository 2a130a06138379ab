// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What Limpid writes to VTK's log, which ParaView shows in View > Log Viewer.

#ifndef limpid_Log_h
#define limpid_Log_h

#include "vtkLimpidFiltersModule.h" // for export macro
#include "vtkLogger.h"

namespace limpid
{
/// Returns the verbosity of all messages of Limpid: that of the environment variable
/// LIMPID_LOG_VERBOSITY, a name or number as vtkLogger knows them (INFO shows them on the terminal,
/// OFF drops them), or TRACE if it is not set or has another value.
VTKLIMPIDFILTERS_EXPORT vtkLogger::Verbosity LogVerbosity();
}

/// Logs a line with the format of printf.
#define limpidLog(...) vtkVLogF(limpid::LogVerbosity(), __VA_ARGS__)

/// Logs a line, and the time until the end of the block.
#define limpidLogScope(...) vtkVLogScopeF(limpid::LogVerbosity(), __VA_ARGS__)

#endif
