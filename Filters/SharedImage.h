// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// An image that is distributed over ranks.

#ifndef limpid_SharedImage_h
#define limpid_SharedImage_h

#include "vtkLimpidFiltersModule.h" // for export macro

#include "distributed/ScenePiece.h"

#include "vtkSmartPointer.h"

#include <array>
#include <memory>

class vtkFloatArray;
class vtkImageData;

namespace limpid
{
struct VTKLIMPIDFILTERS_EXPORT SharedImage
{
  Grid grid; ///< grid of the whole image
  std::shared_ptr<const ScenePiece> piece;

  /// The piece, including ghost layers, as if all of it were owned.
  vtkSmartPointer<vtkImageData> image;

  /// `whole`: the extent of all pieces together. Throws limpid::Error on all ranks if pieces do not
  /// fit.
  SharedImage(std::shared_ptr<const Communicator> ranks, vtkImageData* input,
    const std::array<int, 6>& whole);

  /// Sets ghost points to the values of their owner, the only rank that is sure to know all cells
  /// around a point.
  void CopyFromOwners(vtkFloatArray* field) const;
};

/// Reduces `low` to the least and `high` to the largest of all ranks; NaN: this rank has none.
VTKLIMPIDFILTERS_EXPORT void JoinRange(const Communicator& ranks, double& low, double& high);
}

#endif
