// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * Sets ParaView's animation of a view's camera.
 */

#ifndef LimpidCameraAnimation_h
#define LimpidCameraAnimation_h

#include "scene/RaySource.h"

#include <vector>

class vtkSMRenderViewProxy;

/// Replaces the animation of a view's camera by a round trip through cameras that share everything
/// but their position: one frame for each of them, and the first one again at the end. The change
/// is part of undo and trace.
void AnimateCamera(vtkSMRenderViewProxy* view, const std::vector<limpid::Camera>& frames);

#endif
