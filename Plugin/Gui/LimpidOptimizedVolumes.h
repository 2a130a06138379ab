// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * Finds the optimised volumes of a view, and controls them bypassing the server manager.
 *
 * These controls are not properties of the representation, so they are in no state, trace or undo
 * step. They reach the objects on all processes, so also on the one that draws.
 */

#ifndef LimpidOptimizedVolumes_h
#define LimpidOptimizedVolumes_h

#include <vector>

class vtkSMProxy;
class vtkSMRenderViewProxy;
class vtkSMViewProxy;

/// Returns the active view if it has a camera, else null. (A comparative view has none of its own.)
vtkSMRenderViewProxy* ActiveRenderView();

/// Returns whether a display shows an optimised volume.
bool IsOptimizedVolume(vtkSMProxy* display);

/// Returns the visible representations of type "Optimized Volume" in a view, as sub-proxies. Empty
/// for null.
std::vector<vtkSMProxy*> VisibleOptimizedVolumes(vtkSMViewProxy* view);

/// How the following still renders are made: completely, in one step per render, or like
/// interactive ones (vtkOptimizedVolumeRepresentation).
enum class StillRenders
{
  Whole,
  Stepwise,
  Deferred
};
void SetStillRenders(vtkSMProxy* volume, StillRenders how);

/// Returns whether the last frame was complete, as reported by the process that drew it.
bool IsConverged(vtkSMProxy* volume);

/// Returns whether all is known about what the last picture shows of structures.
bool AreStructuresMeasured(vtkSMProxy* volume);

/// Measures that, on the process that draws. It may take as long as the picture.
void MeasureStructures(vtkSMProxy* volume);

/// Returns the row of the structure that is seen at a place of the view, in [0, 1] from its lower
/// left corner; -1: none.
int PickStructure(vtkSMProxy* volume, double x, double y);

/// Computes a part of the unoptimized picture of a finished view, on all processes. Returns whether
/// work is left.
bool PrepareOriginal(vtkSMProxy* volume);

#endif
