// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/RayGeometry.h"

#include "backend/Backend.h"
#include "backend/Simd.h"

#include <cmath>

namespace limpid
{
namespace
{
/// Length of a ray with the squares of its step per unit of depth along u, v and w.
LIMPID_INLINE float LengthOf(double u, double v, double w)
{
  return static_cast<float>(std::sqrt(u + v + w));
}

LIMPID_INLINE double Squared(double value)
{
  return value * value;
}

LIMPID_MULTIVERSION
void FindLengths(const double* __restrict slopes, int count, const Vec3& spacing, double slopeV,
  float* __restrict lengths)
{
  const double spacingU = spacing.x;
  const double squareV = Squared(slopeV * spacing.y);
  const double squareW = Squared(spacing.z);
  for (int i = 0; i < count; ++i)
  {
    lengths[i] = LengthOf(Squared(slopes[i] * spacingU), squareV, squareW);
  }
}

/// Indices that are marked, as a span.
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

/// A plane of a frustum as a condition on the rays of a row: u x + first + second + offset >= 0 at
/// the coordinate x.
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

float FaceFrustum::RayLength(int column, int row) const
{
  return LengthOf(Squared(this->columnAxis.slope[std::size_t(column)] * this->spacing.x),
    Squared(this->rowAxis.slope[std::size_t(row)] * this->spacing.y), Squared(this->spacing.z));
}

void FaceFrustum::FindRayLengths(int row, float* lengths) const
{
  FindLengths(this->columnAxis.slope.data(), this->columns, this->spacing,
    this->rowAxis.slope[std::size_t(row)], lengths);
}

Range<int> InsideColumns(const FaceFrustum& frustum, float front, float back)
{
  const RayAxis& axis = frustum.columnAxis;
  return FindInside(
    axis.entry.data(), axis.exit.data(), axis.share.data(), frustum.columns, front, back);
}

std::vector<float> FindInView(const FaceFrustum& frustum, const RaySource& eye, double w)
{
  if (eye.viewPlanes.empty())
  {
    return {};
  }
  const std::vector<double>& columns = frustum.lateralU.Coordinates();
  std::vector<float> inView(std::size_t(frustum.RayCount()), 1.0f);
  ParallelFor(frustum.rows, 16,
    [&](Index row)
    {
      const double coordinate = frustum.lateralV.Coordinate(static_cast<int>(row));
      for (const RaySource::Plane& plane : eye.viewPlanes)
      {
        // Summed in the order of the grid's axes.
        const double alongV = plane.normal[frustum.axisV] * coordinate;
        const double alongW = plane.normal[frustum.axisW] * w;
        const bool depthLast = frustum.axisV < frustum.axisW;
        HideBehind({ plane.normal[frustum.axisU], depthLast ? alongV : alongW,
                     depthLast ? alongW : alongV, plane.offset },
          columns.data(), frustum.columns, inView.data() + row * frustum.columns);
      }
    });
  return inView;
}
}
