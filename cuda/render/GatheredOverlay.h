// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_GatheredOverlay_h
#define limpid_render_GatheredOverlay_h

#include "distributed/ScenePiece.h"
#include "render/PackedNumbers.h"

#include <functional>
#include <vector>

namespace limpid
{
/// Gathers the numbers of an overlay that is distributed over ranks, at the nodes of a coarse grid
/// over the box of all ranks. Each node has the numbers of the rank that owns the nearest node of
/// `whole`; without owner, nothing is changed. `resample`: returns the numbers of a part of the
/// grid, whose nodes are this rank's. Collective.
std::vector<TwoPacked> GatheredOverlay(const ScenePiece& piece, const Grid& whole, const Grid& grid,
  const std::function<std::vector<TwoPacked>(const Grid& part)>& resample);
}

#endif
