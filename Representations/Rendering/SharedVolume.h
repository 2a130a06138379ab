// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A volume of which every process has a piece, and what each needs of the others' to draw its own.

#ifndef limpid_SharedVolume_h
#define limpid_SharedVolume_h

#include "scene/ScenePiece.h"

#include "vtkSmartPointer.h"

#include <array>
#include <memory>
#include <vector>

class vtkFloatArray;
class vtkImageData;

namespace limpid
{
/// How far samples may be apart where processes draw together [nodes].
constexpr double farthestShared = 2;

class SharedVolume
{
public:
  /// `input`: the piece of this process, which may have no points; `whole`: the extent of all.
  /// All processes have to make it. Throws limpid::Error on all where pieces do not fit.
  SharedVolume(std::shared_ptr<const Communicator> ranks, vtkImageData* input,
    const std::array<int, 6>& whole);

  const Grid& Whole() const { return this->WholeGrid; }

  /// The nodes that this process owns, and those around them that drawing takes.
  const std::shared_ptr<const ScenePiece>& Drawn() const { return this->DrawnPiece; }

  /// The input, whose ghosts are as good as other points.
  vtkImageData* Here() const;

  /// A field at the points of the input at the nodes that are drawn, `otherwise` where nobody has
  /// any. All processes have to ask.
  vtkSmartPointer<vtkFloatArray> Extended(vtkFloatArray* field, float otherwise) const;

  /// Shares likewise; none, if no process has any.
  std::vector<float> Extended(const std::vector<float>& shares) const;

private:
  void Extend(const float* field, float* extended) const;

  Grid WholeGrid;
  std::shared_ptr<const ScenePiece> HerePiece;
  std::shared_ptr<const ScenePiece> DrawnPiece;
  vtkSmartPointer<vtkImageData> Image;
};
}

#endif
