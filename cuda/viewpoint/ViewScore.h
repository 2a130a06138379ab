// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_ViewScore_h
#define limpid_viewpoint_ViewScore_h

#include "backend/Choice.h"
#include "viewpoint/ScoreSweep.h"

#include <memory>
#include <string>

namespace limpid
{
/// The score of a camera and its derivative by the camera's position.
struct ViewSlope
{
  double score = 0;  ///< S [length^2]
  Vec3 slope{ 0.0 }; ///< dS / d position, perpendicular to the line of sight [length]
};

/**
 * Scores of cameras that look at the same fields, each by one front-to-back sweep (Eq. (32)). The
 * whole volume counts, inside the view or not.
 *
 * `backend` as in Settings; throws limpid::Error if it is not available. The fields,
 * grid.NodeCount() values each, are copied. `rayDensity`: minimum number of rays per voxel and
 * axis; small volumes get more.
 *
 * For attainable fields (ViewedFields), S is the ceiling of the kept extinction: an upper bound of
 * what an optimisation could show there, at the cost of a score. Its slope is computed from four
 * more scores.
 *
 * Fields that processes share must outlive this object. Scores are then collective, and every
 * process gets the result.
 */
class ViewScore
{
public:
  ViewScore(const Grid& grid, const ViewedFields& viewed, double rayDensity,
    BackendKind backend = BackendKind::Cpu);

  /// Describes the backend for the user.
  const std::string& BackendName() const { return this->Name; }

  const ViewFields& Seen() const { return *this->Fields; }

  /// Thread-safe, unless processes share the fields.
  Score At(const Camera& camera) const;

  /// Returns S, from more samples at a `rayDensity` of two and more, and its derivative by the
  /// camera's position, from one sweep (Documentation/Method.md, section on viewpoints).
  ViewSlope SlopeAt(const Camera& camera) const;

private:
  ViewSlope DifferenceAt(const Camera& camera) const;

  std::unique_ptr<const ViewFields> Fields; ///< at a fixed address, even if this object moves
  double RayDensity;
  std::string Name;
  std::unique_ptr<ScoreSweep> Sweep;
};
}

#endif
