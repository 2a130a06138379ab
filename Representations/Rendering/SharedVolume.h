// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A volume that is distributed over processes, with the ghosts that each needs to draw its piece.

#ifndef limpid_SharedVolume_h
#define limpid_SharedVolume_h

#include "render/DrawnPart.h"

#include "vtkSmartPointer.h"

#include <array>
#include <memory>
#include <vector>

class vtkFloatArray;
class vtkImageData;
class vtkUnsignedShortArray;

namespace limpid
{
/// The largest distance of samples if processes draw together [nodes].
constexpr double farthestShared = 2;

class SharedVolume
{
public:
  /// `input`: the piece of this process, which may have no points; `whole`: the extent of all
  /// pieces. Collective. Throws limpid::Error on all processes if pieces do not fit.
  SharedVolume(std::shared_ptr<const Communicator> ranks, vtkImageData* input,
    const std::array<int, 6>& whole);

  /// Returns the nodes that this process owns, and the ghosts around them that drawing reads.
  const DrawnPart& Drawn() const { return this->Part; }

  /// Returns the input with ghost points treated as ordinary points.
  vtkImageData* Here() const;

  /// Extends a field at the points of the input to all nodes that are drawn; `otherwise`: value
  /// where no process has one. Collective.
  vtkSmartPointer<vtkFloatArray> Extended(vtkFloatArray* field, float otherwise) const;

  /// Extends shares in this way; empty if no process has any. Collective.
  std::vector<float> Extended(const std::vector<float>& shares) const;

  /// Extends rows of structures in this way; 0 where no process has one. Collective.
  vtkSmartPointer<vtkUnsignedShortArray> Extended(vtkUnsignedShortArray* rows) const;

private:
  void Extend(const float* field, float* extended) const;

  std::shared_ptr<const ScenePiece> HerePiece;
  DrawnPart Part;
  vtkSmartPointer<vtkImageData> Image;
};
}

#endif
