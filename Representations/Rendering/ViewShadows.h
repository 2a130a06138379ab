// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The shadows of one volume in one renderer, as fine as the time of a frame allows.

#ifndef limpid_ViewShadows_h
#define limpid_ViewShadows_h

#include "Frame.h"

#include "optimize/PassTime.h"
#include "render/Renderer.h"

#include <cstddef>

namespace limpid
{
class ViewShadows
{
public:
  explicit ViewShadows(Renderer& pictures)
    : Pictures(pictures)
  {
  }

  /// Computes them if the next picture would, as fine as the extinction that casts them, however
  /// long it takes. `still`: with the rays of pictures at rest.
  void MakeFine(bool still);

  /// Computes them if the next picture would, as fine as a moving frame has time for. `grid`: of
  /// the extinction that casts them; `whole`: of the volume, all of it.
  void MakeInTime(const FrameSettings& frame, const Grid& grid, const Grid& whole);

private:
  Renderer& Pictures;
  PassTime Time;
  std::size_t Level = 0; ///< how coarse those of the last moving frame were
  Index Nodes = 0;       ///< of their grid
};
}

#endif
