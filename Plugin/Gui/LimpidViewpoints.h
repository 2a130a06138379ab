// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * What a ViewpointSearch found, brought from wherever it runs to the client, and cameras for it.
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
  limpid::Orbit Orbit;               // of the search
  std::vector<limpid::Vec3> Corners; // of the image's box
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
 * The viewpoints of a search that was executed; none if there was an error.
 */
LimpidViewpoints FindViewpoints(vtkSMSourceProxy* search, double time);

/**
 * The camera that shows the whole image in a view, whatever the shape of its window, from a
 * viewpoint's direction.
 */
limpid::Camera CameraOf(const LimpidViewpoint& viewpoint, vtkSMRenderViewProxy* view);

/**
 * Whether points or cells of any output of the search are selected.
 */
bool HasSelection(vtkSMSourceProxy* search);

/**
 * The viewpoint with the highest score among the selected points, and corners of selected cells, of
 * all outputs.
 */
std::optional<LimpidViewpoint> FindBestSelected(vtkSMSourceProxy* search, double time);

#endif
