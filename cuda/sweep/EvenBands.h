// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_EvenBands_h
#define limpid_sweep_EvenBands_h

#include "sweep/FaceFrustum.h"

#include <vector>

namespace limpid
{
/// Slices of a frustum, front to back, whose rows of rays are divided alike.
constexpr int slicesPerStretch = 8;

/// What it takes to pass a ray to another band: up to 70 bytes are copied, sent and copied [ns].
constexpr Index timeOfPassing = 20;

/// What a sweep takes on a slice of each row of rays and of the voxels beside it, about, of one
/// processor [ns].
std::vector<Index> WorkOfRows(const FaceFrustum& frustum, int s);

/**
 * Divides the rows of rays of a frustum into consecutive bands that are about even on every
 * stretch of slices, as those who sweep them wait for each other on every slice.
 *
 * Between stretches rows pass from band to band, with all that their rays carry. That costs, too:
 * of all ways of a border from stretch to stretch it takes the one for which
 *
 *   sum over stretches of |work in front of the border - its share| + cost of the rows passed
 *
 * is least.
 *
 * Returns of each stretch where its bands begin, and the end of the last one.
 */
std::vector<std::vector<int>> FindEvenBands(const FaceFrustum& frustum, int bands);
}

#endif
