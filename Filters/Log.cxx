// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Log.h"

#include <cstdlib>

namespace limpid
{
vtkLogger::Verbosity LogVerbosity()
{
  static const vtkLogger::Verbosity verbosity = []
  {
    const char* name = std::getenv("LIMPID_LOG_VERBOSITY");
    const vtkLogger::Verbosity wanted =
      name ? vtkLogger::ConvertToVerbosity(name) : vtkLogger::VERBOSITY_INVALID;
    return wanted == vtkLogger::VERBOSITY_INVALID ? vtkLogger::VERBOSITY_TRACE : wanted;
  }();
  return verbosity;
}
}
