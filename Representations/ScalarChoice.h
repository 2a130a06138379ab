// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The array that a volume shows, and its colours, if the user has chosen none.

#ifndef limpid_ScalarChoice_h
#define limpid_ScalarChoice_h

#include <array>

class vtkColorTransferFunction;
class vtkDataArray;
class vtkImageData;
class vtkPiecewiseFunction;

namespace limpid
{
struct ScalarChoice
{
  vtkDataArray* array = nullptr; ///< null: there is no such array
  bool onCells = false;
};

/// Returns the point or cell array of that name.
ScalarChoice FindScalars(vtkImageData* image, const char* name, bool onCells);

/**
 * Returns the active scalars of the points, or else of the cells, or else the first numeric array
 * of the points, or else of the cells. The array `last` is used only if there is no other.
 */
ScalarChoice ChooseScalars(vtkImageData* image, const char* last);

/// Sets an opacity ramp from 0 to 1 and ParaView's cool to warm colours over a range.
void SpreadOverRange(
  std::array<double, 2> range, vtkColorTransferFunction* colors, vtkPiecewiseFunction* opacity);
}

#endif
