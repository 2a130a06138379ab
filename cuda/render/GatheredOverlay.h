// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_GatheredOverlay_h
#define limpid_render_GatheredOverlay_h

#include "render/DrawnPart.h"
#include "render/PackedNumbers.h"

#include <functional>
#include <vector>

namespace limpid
{
/// Gathers the numbers of the overlays of all parts, at the nodes of a coarse grid over the whole.
/// Each node has the numbers of the part that owns the nearest node; without owner, nothing is
/// changed. `resample`: returns the numbers of this part at some nodes of the grid. Collective.
std::vector<TwoPacked> GatheredOverlay(const DrawnPart& drawn, const Grid& grid,
  const std::function<std::vector<TwoPacked>(const Grid& some)>& resample);
}

#endif
