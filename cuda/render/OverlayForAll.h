// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_OverlayForAll_h
#define limpid_render_OverlayForAll_h

#include "render/PackedNumbers.h"
#include "scene/ScenePiece.h"

#include <functional>
#include <vector>

namespace limpid
{
/// The numbers of an overlay that ranks have of a piece each, at the nodes of a coarse grid over
/// the box of all, on every rank: each node's are those of the rank that owns the node of `whole`
/// that is nearest; where nobody does, nothing is changed. `resample`: makes those of a part of the
/// grid, whose nodes are this rank's. All ranks have to ask.
std::vector<TwoPacked> OverlayForAll(const ScenePiece& piece, const Grid& whole, const Grid& grid,
  const std::function<std::vector<TwoPacked>(const Grid& part)>& resample);
}

#endif
