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
 * The blanked points and cells of an image, by its arrays "vtkGhostType". Hidden and duplicate
 * points, and hidden, duplicate and refined cells are treated as missing.
 *
 * Fields are interpolated between points, so a blanked cell is empty if all of its points are. A
 * field that is averaged from cells has one sample per cell and loses only those of blanked cells.
 */
class VTKLIMPIDFILTERS_EXPORT Blanking
{
public:
  /// Throws if an array of that name does not have VTK's form: one unsigned char per point or cell.
  explicit Blanking(vtkImageData* image);

  /// Returns the latest modification time of the arrays; 0 without arrays.
  vtkMTimeType MTime() const;

  /// Returns flags for averaging over the cells that are not blanked; null if no cell is blanked.
  vtkSmartPointer<vtkUnsignedCharArray> HiddenCells() const;

  /// Returns the share of a field's value that is kept at each point [0, 1]; empty if everything is
  /// kept. It is 0 at blanked points. `ofCells`: for a field that is averaged from cells, it is the
  /// share of the cells around the point that are not blanked. For a field of points, it is 0 at
  /// the points of blanked cells.
  std::vector<float> Shares(bool ofCells) const;

private:
  bool IsBlanked(vtkIdType cell) const;
  float ShareOfPoint(int i, int j, int k, bool ofCells) const;

  std::array<int, 3> Nodes;
  vtkUnsignedCharArray* PointFlags; ///< null: no points are blanked
  vtkUnsignedCharArray* CellFlags;  ///< null: no cells are blanked
};
}

#endif
