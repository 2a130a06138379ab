// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * The optimised volumes of a view, and what a client says to them past the server manager.
 *
 * What is said here is no property of the representation, so it is in no state, trace or undo
 * step. It reaches the objects on all processes, wherever the picture is made.
 */

#ifndef LimpidOptimizedVolumes_h
#define LimpidOptimizedVolumes_h

#include <vector>

class vtkSMProxy;
class vtkSMRenderViewProxy;
class vtkSMViewProxy;

/// The active view if it has a camera, else null: a comparative view has none of its own.
vtkSMRenderViewProxy* ActiveRenderView();

/// Whether a display shows an optimised volume.
bool IsOptimizedVolume(vtkSMProxy* display);

/// The visible representations of type "Optimized Volume" in a view: their own sub-proxies. None
/// for null.
std::vector<vtkSMProxy*> VisibleOptimizedVolumes(vtkSMViewProxy* view);

/// How the following still renders are made: at once, in steps of one render each, or like
/// interactive ones (vtkOptimizedVolumeRepresentation).
enum class StillRenders
{
  Whole,
  Stepwise,
  Deferred
};
void SetStillRenders(vtkSMProxy* volume, StillRenders how);

/// Whether the last frame left nothing to do, as the process that made the picture knows it.
bool IsConverged(vtkSMProxy* volume);

/// Makes a part of the picture without optimization beside a finished one, on all processes.
/// Returns whether something is left to be done.
bool PrepareOriginal(vtkSMProxy* volume);

#endif
