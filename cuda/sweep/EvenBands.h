// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_EvenBands_h
#define limpid_sweep_EvenBands_h

#include "sweep/FaceFrustum.h"

#include <vector>

namespace limpid
{
/// Number of slices in a stretch, which has one decomposition of the rows of rays.
constexpr int slicesPerStretch = 8;

/// Cost of moving a ray to another band: up to 70 bytes are packed, sent and unpacked [ns].
constexpr Index timeOfPassing = 20;

/// Estimates the time that one processor spends on each row of rays of slice `s`, including the
/// voxels next to it [ns].
std::vector<Index> WorkOfRows(const FaceFrustum& frustum, int s);

/**
 * Decomposes the rows of rays of a frustum into subdomains, bands of consecutive rows, of about
 * equal work, because bands wait for each other on every slice. Each stretch has its own bands.
 *
 * Between stretches, rows change bands together with all values that their rays carry, which has a
 * cost. For each border between two bands, the function picks the positions that minimise
 *
 *    sum over stretches of |work in front of the border - its share| + cost of the rows moved.
 *
 * Returns, for each stretch, the first row of every band, followed by the end of the last band.
 */
std::vector<std::vector<int>> FindEvenBands(const FaceFrustum& frustum, int bands);
}

#endif
