// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * What a filter of Limpid takes over from a volume on display.
 */

#ifndef LimpidTakeOver_h
#define LimpidTakeOver_h

class vtkSMProxy;
class vtkSMRenderViewProxy;

/// Gives a filter of Limpid what a display of its input has, property by property of the same name:
/// importance, weights and method of an optimised volume; array, opacity function and unit distance
/// of any volume; and the camera of a view, of which a search takes the axis that is upwards.
void TakeOverDisplay(vtkSMProxy* filter, vtkSMProxy* display, vtkSMRenderViewProxy* view);

#endif
