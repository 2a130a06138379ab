// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * ParaView's animation of a view's camera.
 */

#ifndef LimpidCameraAnimation_h
#define LimpidCameraAnimation_h

#include "scene/RaySource.h"

#include <vector>

class vtkSMRenderViewProxy;

/// Makes the animation of a view's camera a round trip through cameras that share all but their
/// position, in place of what it was: one frame for each of them, and the first one again at the
/// end. It can be undone, and the trace has it.
void AnimateCamera(vtkSMRenderViewProxy* view, const std::vector<limpid::Camera>& frames);

#endif
