// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// An image of which every rank has a piece.

#ifndef limpid_SharedImage_h
#define limpid_SharedImage_h

#include "vtkLimpidFiltersModule.h" // for export macro

#include "scene/ScenePiece.h"

#include "vtkSmartPointer.h"

#include <array>
#include <memory>

class vtkFloatArray;
class vtkImageData;

namespace limpid
{
struct VTKLIMPIDFILTERS_EXPORT SharedImage
{
  Grid grid; ///< of the whole
  std::shared_ptr<const ScenePiece> piece;

  /// The piece, with layers that other ranks have, too, as if they were its own.
  vtkSmartPointer<vtkImageData> image;

  /// `whole`: the extent of all pieces. Throws limpid::Error on all ranks where pieces do not fit.
  SharedImage(std::shared_ptr<const Communicator> ranks, vtkImageData* input,
    const std::array<int, 6>& whole);

  /// Gives the points that several ranks have the values of the one that they count for: only there
  /// all cells round a point are sure to be known.
  void TakeOwners(vtkFloatArray* field) const;
};

/// The least and the largest of all ranks' numbers, where `low` and `high` are those of one; NaN:
/// it has none.
VTKLIMPIDFILTERS_EXPORT void JoinRange(const Communicator& ranks, double& low, double& high);
}

#endif
