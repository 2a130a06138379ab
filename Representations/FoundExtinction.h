// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How a client begins to show the image of the filter Extinction Optimizer.

#ifndef limpid_FoundExtinction_h
#define limpid_FoundExtinction_h

#include "DisplayColoring.h"

class vtkSMProxy;

namespace limpid
{
/// Lets a volume of a display of that image show the extinction that the filter found, as it found
/// it; unless an extinction source or a method was set. Changes nothing in other displays.
void ShowFoundExtinction(vtkSMProxy* volume, vtkSMProxy* display);

/// The scalar array of the filter; none where a display is of other data.
ColorArray ScalarsOfOptimizer(vtkSMProxy* display);
}

#endif
