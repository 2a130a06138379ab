// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/RayGeometry.h"

#include "backend/Backend.h"
#include "backend/Simd.h"
#include "sweep/RayFormulas.h"

#include <algorithm>
#include <vector>

namespace limpid
{
namespace
{
/// Computes the lengths of a row of rays from their slopes.
LIMPID_MULTIVERSION
void FindLengths(
  const double* __restrict slopes, int count, const RowLength& row, float* __restrict lengths)
{
  const RowLength own = row;
  for (int i = 0; i < count; ++i)
  {
    lengths[i] = own.Of(slopes[i]);
  }
}

/// The range of the marked indices.
struct Marks
{
  int begin;
  int last;

  LIMPID_INLINE void Add(int index, bool marked, int none)
  {
    const int first = marked ? index : none;
    const int end = marked ? index : -1;
    this->begin = first < this->begin ? first : this->begin;
    this->last = end > this->last ? end : this->last;
  }
};

LIMPID_MULTIVERSION
Range<int> FindInside(const float* __restrict entries, const float* __restrict exits,
  const float* __restrict shares, int count, float front, float back)
{
  Marks marks{ count, -1 };
  for (int i = 0; i < count; ++i)
  {
    marks.Add(i, (shares[i] != 0) & (entries[i] <= front) & (exits[i] >= back), count);
  }
  const Range<int> inside{ marks.begin, marks.last + 1 };
  return inside.Empty() ? Range<int>{} : inside;
}

LIMPID_MULTIVERSION
void HideBehind(
  const RowPlane& plane, const double* __restrict coordinates, int count, float* __restrict seen)
{
  const RowPlane row = plane;
  for (int i = 0; i < count; ++i)
  {
    seen[i] = row.HasInFront(coordinates[i]) ? seen[i] : 0.0f;
  }
}
}

void FindRayLengths(PlannedFrustum& frustum)
{
  std::vector<double> slopes(static_cast<std::size_t>(frustum.columns));
  for (int column = 0; column < frustum.columns; ++column)
  {
    slopes[std::size_t(column)] = frustum.lateralU.Slope(column);
  }
  ParallelFor(frustum.rows, 16,
    [&](Index index)
    {
      const int row = static_cast<int>(index);
      const Range<int>& columns = frustum.ColumnsOf(row);
      FindLengths(slopes.data() + columns.begin, columns.Length(),
        RowLength(frustum.spacing, frustum.lateralV.Slope(row)),
        frustum.Room(frustum.length) + frustum.RaysBefore(row));
    });
}

Range<int> InsideColumns(
  const FaceFrustum& frustum, const Range<int>& among, float front, float back)
{
  const Range<int> inside = FindInside(frustum.Row(frustum.columnEntry) + among.begin,
    frustum.Row(frustum.columnExit) + among.begin, frustum.Row(frustum.columnShare) + among.begin,
    among.Length(), front, back);
  return inside.Empty() ? inside
                        : Range<int>{ among.begin + inside.begin, among.begin + inside.end };
}

void FindInView(PlannedFrustum& frustum)
{
  ParallelFor(frustum.rows, 16,
    [&](Index index)
    {
      const int row = static_cast<int>(index);
      const Range<int>& columns = frustum.ColumnsOf(row);
      float* inView = frustum.Room(frustum.inView) + frustum.RaysBefore(row);
      std::fill_n(inView, columns.Length(), 1.0f);
      const double coordinate = frustum.lateralV.Coordinate(row);
      const RaySource::Plane* planes = frustum.Row(frustum.viewPlanes);
      for (int plane = 0; plane < frustum.viewPlanes.rowLength; ++plane)
      {
        HideBehind(RowPlane(planes[plane], frustum, coordinate, frustum.viewDepth),
          frustum.lateralU.Coordinates().data() + columns.begin, columns.Length(), inView);
      }
    });
}
}
