// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The formulas of a plan for a single ray, for the processor and for devices.

#ifndef limpid_sweep_RayFormulas_h
#define limpid_sweep_RayFormulas_h

#include "scene/RaySource.h"
#include "sweep/FaceFrustum.h"

#include <cmath>

namespace limpid
{
/// The length of the rays of a row [length].
struct RowLength
{
  double spacingU; ///< world length of an index step along u
  double squareV;  ///< square of the world length per unit of depth along v
  double squareW;

  LIMPID_HD LIMPID_INLINE RowLength(const Vec3& spacing, double slopeV)
    : spacingU(spacing.x)
    , squareV(slopeV * spacing.y * (slopeV * spacing.y))
    , squareW(spacing.z * spacing.z)
  {
  }

  /// Returns the length per unit of depth of the ray with a slope in u.
  LIMPID_HD LIMPID_INLINE float Of(double slopeU) const
  {
    const double alongU = slopeU * this->spacingU;
    return static_cast<float>(std::sqrt(alongU * alongU + this->squareV + this->squareW));
  }
};

/// A plane of a view as a condition on the rays of a row: u x + first + second + offset >= 0 for
/// rays at the coordinate x.
struct RowPlane
{
  double u;
  double first;
  double second;
  double offset;

  /// `viewDepth`: see PlannedFrustum. Terms are added in the order of the grid's axes.
  LIMPID_HD LIMPID_INLINE RowPlane(
    const RaySource::Plane& plane, const FaceFrustum& frustum, double coordinateV, double viewDepth)
    : u(plane.normal[frustum.axisU])
    , offset(plane.offset)
  {
    const double alongV = plane.normal[frustum.axisV] * coordinateV;
    const double alongW = plane.normal[frustum.axisW] * viewDepth;
    const bool depthLast = frustum.axisV < frustum.axisW;
    this->first = depthLast ? alongV : alongW;
    this->second = depthLast ? alongW : alongV;
  }

  LIMPID_HD LIMPID_INLINE bool HasInFront(double coordinateU) const
  {
    return this->u * coordinateU + this->first + this->second + this->offset >= 0;
  }
};
}

#endif
