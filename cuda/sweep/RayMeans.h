// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What voxels read of the rays: means over their hat functions across the rays.

#ifndef limpid_sweep_RayMeans_h
#define limpid_sweep_RayMeans_h

#include "sweep/Plan.h"

#include <cstddef>
#include <vector>

namespace limpid
{
struct RayImages;

/// SideWeight of every voxel along an axis of rays on the slice at `depth`. `voxels`: their rays.
std::vector<float> SideWeights(const Lateral& lateral, const LinearMap& voxels, double depth);

/// Number of values that means need as scratch.
std::size_t MeanScratch(const FaceFrustum& frustum);

/// Transmittance T, and T times the importance behind, of a row of voxels or of rays.
struct SeenRow
{
  float* transmittance; ///< [0, 1]
  float* behind;        ///< [scale^2]
};

/**
 * Means of both over the hat functions of `columns` of voxel row `v`, across the rays. Between rays
 * that enter through a side, transmittance is that at the voxel (see SampleTransmittance), and the
 * means say what it leaves of what is behind.
 *
 * `behind`: importance behind per unit of transmittance, per ray [scale^2]; `scratch`:
 * MeanScratch(frustum) values.
 */
void AverageSeen(const FaceFrustum& frustum, const Slice& slice, int v, const Range<int>& columns,
  const RayImages& images, const std::vector<float>& behind, float* scratch, const SeenRow& out);
}

#endif
