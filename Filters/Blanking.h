// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_Blanking_h
#define limpid_Blanking_h

#include "vtkLimpidFiltersModule.h" // for export macro
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <vector>

class vtkImageData;
class vtkUnsignedCharArray;

namespace limpid
{
/**
 * Which points and cells of an image are blanked: the flags in its arrays "vtkGhostType". Hidden
 * and duplicate points, and hidden, duplicate and refined cells are as if they were not there.
 *
 * Fields are interpolated between points, so nothing is inside a blanked cell when all of its
 * points are empty. A field that is averaged from the cells has a sample per cell, and loses only
 * those of blanked cells.
 */
class VTKLIMPIDFILTERS_EXPORT Blanking
{
public:
  /// Throws unless each array of that name is as VTK has it: one unsigned char per point or cell.
  explicit Blanking(vtkImageData* image);

  /// When the arrays were changed last; 0 without any.
  vtkMTimeType MTime() const;

  /// Flags for an average over the cells that are not blanked; null: all of them count.
  vtkSmartPointer<vtkUnsignedCharArray> HiddenCells() const;

  /// The part of a field's value that is left at each point [0, 1]. No values: all of it at all
  /// points. `ofCells`: the field is averaged from the cells; it is then the part of the cells
  /// round the point that are not blanked. Else it is 0 at points of blanked cells. It is 0 at
  /// blanked points in any case.
  std::vector<float> Shares(bool ofCells) const;

private:
  bool IsBlanked(vtkIdType cell) const;
  float ShareOfPoint(int i, int j, int k, bool ofCells) const;

  std::array<int, 3> Nodes;
  vtkUnsignedCharArray* PointFlags; ///< null: there are none
  vtkUnsignedCharArray* CellFlags;  ///< null: there are none
};
}

#endif
