// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The shadows of one volume in one renderer, as fine as the time limit of a frame allows.

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

  /// Computes shadows if the next picture needs new ones, at the resolution of the extinction that
  /// casts them and without a time limit. `still`: with the rays of still pictures.
  void MakeFine(bool still);

  /// Computes shadows if the next picture needs new ones, as fine as a frame during interaction has
  /// time for. `grid`: of the extinction that casts them; `whole`: of the whole volume.
  void MakeInTime(const FrameSettings& frame, const Grid& grid, const Grid& whole);

private:
  Renderer& Pictures;
  PassTime Time;
  std::size_t Level = 0; ///< coarsening of those of the last frame during interaction
  Index Nodes = 0;       ///< number of nodes of their grid
};
}

#endif
