// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The way from the coarse picture of a view to the sharp one, which would be a jump.

#ifndef limpid_SharpenedPicture_h
#define limpid_SharpenedPicture_h

#include "ViewGeometry.h"

#include "render/Renderer.h"

namespace limpid
{
class SharpenedPicture
{
public:
  /// A coarse picture is shown, and the way begins there.
  void Begin(const Picture& coarse, const PictureFrame& frame, const ViewGeometry& geometry);

  /// Goes on to the sharp picture of that view for so many seconds. `easeTime`: the time constant
  /// [s]. Returns what is to be shown, which is `sharp` where the way is over.
  const Picture& Advance(const Picture& sharp, const PictureFrame& frame,
    const ViewGeometry& geometry, double seconds, double easeTime);

  bool IsOver() const { return this->Remaining == 0; }
  void Clear();

private:
  Picture Coarse;
  PictureFrame CoarseFrame;
  std::array<int, 2> Size{ { 0, 0 } }; ///< of the viewport
  glm::dmat4 ClipToData{ 1.0 };        ///< likewise
  double Remaining = 0;                ///< share of the coarse picture that is still shown
  Picture Shown;
};
}

#endif
