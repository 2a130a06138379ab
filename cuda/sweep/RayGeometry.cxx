// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/RayGeometry.h"

#include "backend/Backend.h"
#include "backend/Simd.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace limpid
{
namespace
{
LIMPID_INLINE double Squared(double value)
{
  return value * value;
}

/// Computes the lengths of a row of rays from their slopes.
LIMPID_MULTIVERSION
void FindLengths(const double* __restrict slopes, int count, const Vec3& spacing, double slopeV,
  float* __restrict lengths)
{
  const double spacingU = spacing.x;
  const double squareV = Squared(slopeV * spacing.y);
  const double squareW = Squared(spacing.z);
  for (int i = 0; i < count; ++i)
  {
    lengths[i] = static_cast<float>(std::sqrt(Squared(slopes[i] * spacingU) + squareV + squareW));
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

/// A plane of a frustum as a condition on the rays of a row: u x + first + second + offset >= 0
/// for rays at the coordinate x.
struct RowPlane
{
  double u;
  double first;
  double second;
  double offset;
};

LIMPID_MULTIVERSION
void HideBehind(
  const RowPlane& plane, const double* __restrict coordinates, int count, float* __restrict seen)
{
  const RowPlane row = plane;
  for (int i = 0; i < count; ++i)
  {
    const bool inside = row.u * coordinates[i] + row.first + row.second + row.offset >= 0;
    seen[i] = inside ? seen[i] : 0.0f;
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
      FindLengths(slopes.data() + columns.begin, columns.Length(), frustum.spacing,
        frustum.lateralV.Slope(row), frustum.Room(frustum.length) + frustum.RaysBefore(row));
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

void FindInView(PlannedFrustum& frustum, const RaySource& source, double w)
{
  ParallelFor(frustum.rows, 16,
    [&](Index index)
    {
      const int row = static_cast<int>(index);
      const Range<int>& columns = frustum.ColumnsOf(row);
      float* inView = frustum.Room(frustum.inView) + frustum.RaysBefore(row);
      std::fill_n(inView, columns.Length(), 1.0f);
      const double coordinate = frustum.lateralV.Coordinate(row);
      for (const RaySource::Plane& plane : source.viewPlanes)
      {
        // Terms are added in the order of the grid's axes.
        const double alongV = plane.normal[frustum.axisV] * coordinate;
        const double alongW = plane.normal[frustum.axisW] * w;
        const bool depthLast = frustum.axisV < frustum.axisW;
        HideBehind({ plane.normal[frustum.axisU], depthLast ? alongV : alongW,
                     depthLast ? alongW : alongV, plane.offset },
          frustum.lateralU.Coordinates().data() + columns.begin, columns.Length(), inView);
      }
    });
}
}
