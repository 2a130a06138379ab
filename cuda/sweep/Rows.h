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
  Range<float> row;         ///< of this row of rays
  const float* columnEntry; ///< of the columns
  const float* columnExit;
  const float* length;        ///< world length per unit of depth
  const float* extinction[2]; ///< at the Gauss points, front and rear [1/length]
  const float* importance[2]; ///< [0, 1]
  Range<int> work;            ///< columns to be visited
  Range<int> inside;          ///< columns that are not clipped
};

/// A blend of two rows of samples: first + weight (second - first), columns [begin, end).
void BlendRows(
  const float* first, const float* second, float weight, int begin, int end, float* out);

/// A blend of two blends, for the bilinear mean of four rows: rows [slice][row], `across` the
/// weight of the second row, `along` that of the second slice.
void BlendFourRows(
  const float* const rows[2][2], float across, float along, int begin, int end, float* out);

/// Two such blends of the same rows.
void BlendFourRowsTwice(const float* const rows[2][2], const float across[2], const float along[2],
  int begin, int end, float* first, float* second);

/// The cubic blend of four rows of samples at -1, 0, 1, 2 between the second and the third
/// (Catmull-Rom); `across`: fraction of the way. Columns [begin, end).
void BlendCubic(const float* const rows[4], float across, int begin, int end, float* out);

/// out[i] = row[i - 1] - 2 row[i] + row[i + 1], columns [begin, end).
void Curve(const float* row, int begin, int end, float* out);

/// Makes the linear interpolation of a row cubic, in place. `curvature`: the same interpolation of
/// the row's Curve; `map`: of both.
void BendRow(
  const LinearMap& map, const float* curvature, const Range<int>& columns, float* values);

/// Puts values that are outside [0, 1] on its border.
void ClampRow(const Range<int>& columns, float* values);

/// Linear interpolation of a row of samples to `columns` of the map's targets. `source` must be
/// readable up to 32 values beyond the last sample.
void InterpolateRow(
  const float* source, const LinearMap& map, const Range<int>& columns, float* out);

/// Front to back: `opticalDepth` grows; it is that since the entry into the box, negative before,
/// and goes on behind the exit, so that nothing jumps between neighbouring rays. `visible` gains
/// the integral of g mu T scale^2 and `unattenuated` that of g mu scale^2, inside the box only.
void ForwardRow(const RayRow& rays, double* opticalDepth, float* visible, float* unattenuated);

/// Front to back, the optical depth alone.
void DeepenRow(const RayRow& rays, double* opticalDepth);

/// Back to front: `opticalDepth` shrinks to that at the front of the layer.
void UnwindRow(const RayRow& rays, double* opticalDepth);

/// What a row of rays carries from the back of the volume to its front.
struct RaysBehind
{
  float* behind;       ///< visible importance behind, times scale^2; goes on ahead of the entry
  float* visible;      ///< the same from the entry into the box on; negative: not there yet
  float* unattenuated; ///< the same without attenuation, inside the box
  double* opticalDepth;
};

/// Back to front: visible importance is carried from the back of the layer to its front, and
/// `opticalDepth` shrinks to that at the front, as in UnwindRow.
void BackwardRow(const RayRow& rays, const RaysBehind& state);

/// Back to front, likewise, but `opticalDepth` grows by that of the layer, as in DeepenRow.
void CollectRow(const RayRow& rays, const RaysBehind& state);

/// `ahead`: what `behind` becomes in the middle of the layer.
void RearHalfRow(const RayRow& rays, const float* behind, float* ahead);

/// transmittance = exp(-opticalDepth).
void TransmitRow(const double* opticalDepth, const Range<int>& columns, float* transmittance);

/// Optical depth per unit of depth since the entry into the box, for rays at a slice.
struct DensityRow
{
  float depth;              ///< relative depth of the slice
  float entry;              ///< of the row, or the front of the box if that is deeper
  const float* columnEntry; ///< of the columns
  const double* opticalDepth;
  const float* length;     ///< world length per unit of depth
  const float* extinction; ///< just behind the slice; null: behind the last one
  bool unwound;            ///< whether `opticalDepth` is known, and negative, ahead of the entry
  float limit;             ///< to optical depths, lest cubics swing beside them
};

/// density = opticalDepth / (depth - entry). It is as smooth as the extinction even where the entry
/// has a kink or lies ahead.
void DensifyRow(const DensityRow& rays, const Range<int>& columns, float* density);

/// Of voxels whose rays enter through a side: transmittance = exp(-density (depth - entry)), in
/// place. `entry`: that of the row or of the front, `columnEntry` that of the columns.
void TransmitVoxelRow(float depth, float entry, const float* columnEntry, const Range<int>& columns,
  float* densityToTransmittance);

/// values *= factors.
void MultiplyRow(float* values, const float* factors, const Range<int>& columns);
}

#endif
