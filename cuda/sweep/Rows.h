// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How the CPU visits samples: one row of rays, or of voxels, at a time, several columns in a
// vector register. The mathematics is in HalfLayer.h.

#ifndef limpid_sweep_Rows_h
#define limpid_sweep_Rows_h

#include "sweep/HalfLayer.h"
#include "sweep/Plan.h"

namespace limpid
{
/// One row of rays in one layer. All arrays are indexed by column.
struct RayRow
{
  Layer layer;
  Clip row;                 ///< of this row of rays
  const float* columnEntry; ///< of the columns
  const float* columnExit;
  const float* length;        ///< world length per unit of depth
  const float* extinction[2]; ///< at the Gauss points, front and rear [1/length]
  const float* importance[2]; ///< [0, 1]
  Interval work;              ///< columns to be visited
  Interval inside;            ///< columns that are not clipped
};

/// A blend of two rows of samples: first + weight (second - first), columns [begin, end).
void BlendRows(
  const float* first, const float* second, float weight, int begin, int end, float* out);

/// A blend of two blends, for the bilinear mean of four rows: rows [slice][row], `across` the
/// weight of the second row, `along` that of the second slice.
void BlendFourRows(
  const float* const rows[2][2], float across, float along, int begin, int end, float* out);

/// Linear interpolation of a row of samples to `columns` of the map's targets. `source` must be
/// readable up to 32 values beyond the last sample.
void InterpolateRow(const float* source, const LinearMap& map, const Interval& columns, float* out);

// Where a ray enters the box through a side, voxels on that side are interpolated between it and
// rays that are not inside yet. So that nothing jumps there, a ray carries its optical depth and
// the importance behind it on through the samples on the border: its optical depth is that since
// its entry, negative before; what it has met behind its exit never counts as visible.

/// Front to back: `opticalDepth` grows, also behind the exit; `visible` gains the integral of
/// g mu T scale^2 and `plain` that of g mu scale^2, inside the box only.
void ForwardRow(const RayRow& rays, double* opticalDepth, float* visible, float* plain);

/// Back to front: `opticalDepth` shrinks to that at the front of the layer.
void UnwindRow(const RayRow& rays, double* opticalDepth);

/// Back to front: `behind`, the visible importance behind, times scale^2, is carried from the back
/// of the layer to its front.
void BackwardRow(const RayRow& rays, float* behind);

/// `ahead`: what `behind` becomes in the middle of the layer.
void RearHalfRow(const RayRow& rays, const float* behind, float* ahead);

/// transmittance = exp(-opticalDepth), above 1 in front of the entry. An optical depth below -1 is
/// taken as -1: there is no voxel so far outside.
void TransmitRow(const double* opticalDepth, const Interval& columns, float* transmittance);

/// values *= factors.
void MultiplyRow(float* values, const float* factors, const Interval& columns);
}

#endif
