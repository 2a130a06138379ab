// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Interpolation and arithmetic of whole rows, several columns per vector register.

#ifndef limpid_sweep_RowInterpolation_h
#define limpid_sweep_RowInterpolation_h

#include "sweep/FaceFrustum.h"

namespace limpid
{
/// Blends two rows: first + weight (second - first), for columns [begin, end).
void BlendRows(
  const float* first, const float* second, float weight, int begin, int end, float* out);

/// Blends four rows bilinearly. `rows`: [slice][row]; `across`: weight of the second row; `along`:
/// weight of the second slice.
void BlendFourRows(
  const float* const rows[2][2], float across, float along, int begin, int end, float* out);

/// Computes two such blends of the same four rows.
void BlendFourRowsTwice(const float* const rows[2][2], const float across[2], const float along[2],
  int begin, int end, float* first, float* second);

/// Blends four rows, at -1, 0, 1, 2, by a Catmull-Rom cubic at the position `across` in [0, 1],
/// for columns [begin, end).
void BlendCubic(const float* const rows[4], float across, int begin, int end, float* out);

/// out[i] = row[i - 1] - 2 row[i] + row[i + 1], columns [begin, end).
void Curve(const float* row, int begin, int end, float* out);

/// Turns the linear interpolation of a row into a cubic one, in place. `curvature`: the row's
/// Curve, interpolated by the same `map`.
void BendRow(
  const LinearMap& map, const float* curvature, const Range<int>& columns, float* values);

/// Clamps values to [0, 1].
void ClampRow(const Range<int>& columns, float* values);

/// Interpolates a row linearly to `columns`, a range of the map's targets. `source` must be
/// readable up to 32 values beyond the last sample.
void InterpolateRow(
  const float* source, const LinearMap& map, const Range<int>& columns, float* out);

/// Computes the lesser of two rows for each column.
void LesserRow(const float* first, const float* second, const Range<int>& columns, float* out);

/// Returns the smallest range of columns that contains all values above 0.
Range<int> ColumnsAboveZero(const float* values, const Range<int>& columns);

/// Returns whether any value of a row exceeds a bound.
bool AnyAbove(const float* values, const Range<int>& columns, float bound);

/// values *= factors.
void MultiplyRow(float* values, const float* factors, const Range<int>& columns);
}

#endif
