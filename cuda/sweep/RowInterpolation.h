// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Interpolation and arithmetic of whole rows of samples, several columns in a vector register.

#ifndef limpid_sweep_RowInterpolation_h
#define limpid_sweep_RowInterpolation_h

#include "sweep/FaceFrustum.h"

namespace limpid
{
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

/// The lesser of two rows, column by column.
void LesserRow(const float* first, const float* second, const Range<int>& columns, float* out);

/// The columns of a row outside of which it is 0.
Range<int> ColumnsAboveZero(const float* values, const Range<int>& columns);

/// Whether any value of a row is above a bound.
bool AnyAbove(const float* values, const Range<int>& columns, float bound);

/// values *= factors.
void MultiplyRow(float* values, const float* factors, const Range<int>& columns);
}

#endif
