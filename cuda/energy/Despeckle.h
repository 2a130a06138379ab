// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_Despeckle_h
#define limpid_energy_Despeckle_h

#include "scene/Grid.h"

namespace limpid
{
/**
 * Removes specks from the importance (Documentation/Deviations.md, D17) by a centre-weighted
 * median over 3 x 3 x 3 nodes in which the centre counts eleven times. A value stays if at least
 * eight of its 26 neighbours are as large or larger, and eight as small or smaller. Otherwise it
 * becomes the eighth of them. Vessels two nodes wide therefore stay, and isolated groups of one to
 * three nodes vanish. Nodes on the border are repeated beyond it.
 *
 * A node without extinction and importance stays without importance. `importance`:
 * grid.NodeCount() finite values; `zeros`: grid.NodeCount() zeros; only other values are written.
 */
void Despeckle(
  const Grid& grid, const float* baseExtinction, const float* importance, float* zeros);
}

#endif
