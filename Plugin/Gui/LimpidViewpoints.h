// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * The cameras that a ViewpointSearch found, brought from wherever it runs to the client.
 */

#ifndef LimpidViewpoints_h
#define LimpidViewpoints_h

#include <array>
#include <optional>
#include <vector>

class vtkSMSourceProxy;

struct LimpidViewpoint
{
  std::array<double, 3> Position;
  std::array<double, 3> FocalPoint;
  std::array<double, 3> ViewUp;
  double ViewAngle; // degrees
  bool ParallelProjection;
  double ParallelScale;
  double VisibleFraction; // of what is important, in [0, 1]
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
 * Whether points or cells of any output of the search are selected.
 */
bool HasSelection(vtkSMSourceProxy* search);

/**
 * The viewpoint with the highest score among the selected points, and corners of selected cells, of
 * all outputs.
 */
std::optional<LimpidViewpoint> FindBestSelected(vtkSMSourceProxy* search, double time);

#endif
