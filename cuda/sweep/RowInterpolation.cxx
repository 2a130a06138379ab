// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/RowInterpolation.h"

#include "backend/Gather.h"
#include "math/Number.h"
#include "sweep/Cubic.h"

namespace limpid
{
LIMPID_MULTIVERSION
void BlendRows(const float* __restrict first, const float* __restrict second, float weight,
  int begin, int end, float* __restrict out)
{
  for (int u = begin; u < end; ++u)
  {
    out[u] = first[u] + weight * (second[u] - first[u]);
  }
}

LIMPID_MULTIVERSION
void BlendFourRows(const float* const rows[2][2], float across, float along, int begin, int end,
  float* __restrict out)
{
  const float* __restrict front0 = rows[0][0];
  const float* __restrict front1 = rows[0][1];
  const float* __restrict back0 = rows[1][0];
  const float* __restrict back1 = rows[1][1];
  for (int u = begin; u < end; ++u)
  {
    const float first = front0[u] + along * (back0[u] - front0[u]);
    const float second = front1[u] + along * (back1[u] - front1[u]);
    out[u] = first + across * (second - first);
  }
}

LIMPID_MULTIVERSION
void BlendFourRowsTwice(const float* const rows[2][2], const float across[2], const float along[2],
  int begin, int end, float* __restrict first, float* __restrict second)
{
  const float* __restrict front0 = rows[0][0];
  const float* __restrict front1 = rows[0][1];
  const float* __restrict back0 = rows[1][0];
  const float* __restrict back1 = rows[1][1];
  const float across0 = across[0];
  const float across1 = across[1];
  const float along0 = along[0];
  const float along1 = along[1];
  for (int u = begin; u < end; ++u)
  {
    const float step0 = back0[u] - front0[u];
    const float step1 = back1[u] - front1[u];
    const float low0 = front0[u] + along0 * step0;
    const float low1 = front0[u] + along1 * step0;
    first[u] = low0 + across0 * ((front1[u] + along0 * step1) - low0);
    second[u] = low1 + across1 * ((front1[u] + along1 * step1) - low1);
  }
}

LIMPID_MULTIVERSION
void BlendCubic(const float* const rows[4], float across, int begin, int end, float* __restrict out)
{
  const float* __restrict before = rows[0];
  const float* __restrict first = rows[1];
  const float* __restrict second = rows[2];
  const float* __restrict after = rows[3];
  for (int i = begin; i < end; ++i)
  {
    out[i] = CubicBetween(before[i], first[i], second[i], after[i], across);
  }
}

LIMPID_MULTIVERSION
void Curve(const float* __restrict row, int begin, int end, float* __restrict out)
{
  for (int i = begin; i < end; ++i)
  {
    out[i] = Curvature(row[i - 1], row[i], row[i + 1]);
  }
}

LIMPID_MULTIVERSION
void BendRow(const LinearMap& map, const float* __restrict curvature, const Range<int>& columns,
  float* __restrict values)
{
  const float* __restrict fractions = map.weight;
  for (int i = columns.begin; i < columns.end; ++i)
  {
    values[i] = Bent(values[i], curvature[i], fractions[i]);
  }
}

LIMPID_MULTIVERSION
void ClampRow(const Range<int>& columns, float* __restrict values)
{
  for (int i = columns.begin; i < columns.end; ++i)
  {
    values[i] = Clamp(values[i], 0.0f, 1.0f);
  }
}

void InterpolateRow(
  const float* source, const LinearMap& map, const Range<int>& columns, float* out)
{
  if (!columns.Empty())
  {
    InterpolateGathered(source, map.index + columns.begin, map.weight + columns.begin,
      columns.end - columns.begin, out + columns.begin);
  }
}

LIMPID_MULTIVERSION
void LesserRow(const float* __restrict first, const float* __restrict second,
  const Range<int>& columns, float* __restrict out)
{
  for (int i = columns.begin; i < columns.end; ++i)
  {
    out[i] = first[i] < second[i] ? first[i] : second[i];
  }
}

Range<int> ColumnsAboveZero(const float* values, const Range<int>& columns)
{
  Range<int> others = columns;
  while (!others.Empty() && !(values[others.begin] > 0.0f))
  {
    ++others.begin;
  }
  while (!others.Empty() && !(values[others.end - 1] > 0.0f))
  {
    --others.end;
  }
  return others;
}

LIMPID_MULTIVERSION
bool AnyAbove(const float* values, const Range<int>& columns, float bound)
{
  int above = 0;
  for (int i = columns.begin; i < columns.end; ++i)
  {
    above |= values[i] > bound ? 1 : 0;
  }
  return above != 0;
}

LIMPID_MULTIVERSION
void MultiplyRow(
  float* __restrict values, const float* __restrict factors, const Range<int>& columns)
{
  for (int i = columns.begin; i < columns.end; ++i)
  {
    values[i] *= factors[i];
  }
}
}
