// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The initial settings of a display that shows the image of the filter Extinction Optimizer.

#ifndef limpid_FoundExtinction_h
#define limpid_FoundExtinction_h

#include "DisplayColoring.h"

class vtkSMProxy;

namespace limpid
{
/// Makes the volume of such a display show the filter's optimised extinction unchanged, unless an
/// extinction source or a method was set. Other displays are not changed.
void ShowFoundExtinction(vtkSMProxy* volume, vtkSMProxy* display);

/// Returns the scalar array of the filter; none if the display shows other data.
ColorArray ScalarsOfOptimizer(vtkSMProxy* display);
}

#endif
