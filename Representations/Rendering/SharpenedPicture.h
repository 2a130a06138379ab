// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The gradual transition from the coarse picture of a view to the sharp one, instead of a jump.

#ifndef limpid_SharpenedPicture_h
#define limpid_SharpenedPicture_h

#include "ViewGeometry.h"

#include "render/Renderer.h"

namespace limpid
{
class SharpenedPicture
{
public:
  /// Starts the transition from a coarse picture, which is shown now.
  void Begin(const Picture& coarse, const PictureFrame& frame, const ViewGeometry& geometry);

  /// Advances the transition to the sharp picture of that view by this time [s]. `easeTime`: time
  /// constant [s]. Returns the picture to show; it is `sharp` once the transition is complete.
  const Picture& Advance(const Picture& sharp, const PictureFrame& frame,
    const ViewGeometry& geometry, double seconds, double easeTime);

  bool IsOver() const { return this->Remaining == 0; }
  void Clear();

private:
  Picture Coarse;
  PictureFrame CoarseFrame;
  std::array<int, 2> Size{ { 0, 0 } }; ///< size of the viewport
  glm::dmat4 ClipToData{ 1.0 };        ///< of the viewport
  double Remaining = 0;                ///< weight of the coarse picture
  Picture Shown;
};
}

#endif
