// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * Gets the results of a ViewpointSearch on the client, and cameras for them.
 */

#ifndef LimpidViewpoints_h
#define LimpidViewpoints_h

#include "viewpoint/FittedCamera.h"

#include <optional>
#include <vector>

class vtkSMRenderViewProxy;
class vtkSMSourceProxy;

struct LimpidViewpoint
{
  limpid::Orbit Orbit;               // cameras of the search
  std::vector<limpid::Vec3> Corners; // corners of the image's box
  limpid::Aim Aim = limpid::Aim::Box;
  limpid::Vec3 Direction{ 0.0, 0.0, 1.0 }; // unit vector from the orbit's centre
  double VisibleFraction = 0;              // of the important structures, in [0, 1]
};

struct LimpidViewpoints
{
  std::vector<LimpidViewpoint> Ranked; // best first
  std::optional<LimpidViewpoint> Worst;
};

/**
 * Returns the viewpoints of a search that was executed; none after an error.
 */
LimpidViewpoints FindViewpoints(vtkSMSourceProxy* search, double time);

/**
 * Returns a camera that shows the whole image from a viewpoint's direction, for any shape of the
 * view's window.
 */
limpid::Camera CameraOf(const LimpidViewpoint& viewpoint, vtkSMRenderViewProxy* view);

/**
 * Returns whether points or cells of any output of the search are selected.
 */
bool HasSelection(vtkSMSourceProxy* search);

/**
 * Returns the viewpoint with the highest score among the selected points and the corners of
 * selected cells, in all outputs.
 */
std::optional<LimpidViewpoint> FindBestSelected(vtkSMSourceProxy* search, double time);

#endif
