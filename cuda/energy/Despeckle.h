// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_Despeckle_h
#define limpid_energy_Despeckle_h

#include "scene/Grid.h"

namespace limpid
{
/**
 * Importance without its specks (Documentation/Deviations.md, D17): a centre-weighted median of
 * 3 x 3 x 3 nodes in which the centre counts eleven times. A value stays if eight of its 26
 * neighbours are as large or larger, and eight as small or smaller; else it becomes the eighth of
 * them. So vessels that are two nodes wide stay, and what one to three nodes have alone goes. On
 * the border, the nodes of the border stand for those beyond.
 *
 * A node that has neither extinction nor importance stays without importance. `importance`:
 * grid.NodeCount() finite values; `zeros`: room for as many, all 0: what is 0 is not written.
 */
void Despeckle(
  const Grid& grid, const float* baseExtinction, const float* importance, float* zeros);
}

#endif
