// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * Copies settings of a displayed volume to a filter of Limpid.
 */

#ifndef LimpidTakeOver_h
#define LimpidTakeOver_h

class vtkSMProxy;
class vtkSMRenderViewProxy;

/// Copies from a display of the filter's input, property by property of the same name: importance,
/// structures, weights and method of an optimised volume; array, opacity function and unit distance
/// of any volume. Also copies the camera of a view; a search gets only its up axis.
void TakeOverDisplay(vtkSMProxy* filter, vtkSMProxy* display, vtkSMRenderViewProxy* view);

#endif
