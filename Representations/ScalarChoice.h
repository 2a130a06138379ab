// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Which array a volume shows, and in which colours, when the user has chosen none.

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
  vtkDataArray* array = nullptr; ///< none: there is no such array
  bool onCells = false;
};

/// The array of that name, of the points or of the cells.
ScalarChoice FindScalars(vtkImageData* image, const char* name, bool onCells);

/**
 * The active scalars of the points or else of the cells, or else the first array with numbers of
 * the points or else of the cells. An array of the name `last` is taken only if there is no other.
 */
ScalarChoice ChooseScalars(vtkImageData* image, const char* last);

/// A straight line from 0 to 1 and ParaView's cool to warm colours over a range.
void SpreadOverRange(
  std::array<double, 2> range, vtkColorTransferFunction* colors, vtkPiecewiseFunction* opacity);
}

#endif
