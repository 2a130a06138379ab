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
/// The score of a camera and how it changes when the camera moves.
struct ViewSlope
{
  double score = 0;  ///< S [length^2]
  Vec3 slope{ 0.0 }; ///< dS / d position, across the way to the focal point [length]
};

/**
 * Scores of cameras that look at the same fields, by one sweep front to back each (Eq. (32)). All
 * of the volume counts, in view or not.
 *
 * `backend` as in Settings; throws limpid::Error if it cannot be had. The fields, grid.NodeCount()
 * values each, are copied. `rayDensity`: rays per voxel and axis, at least; what is small gets
 * more.
 *
 * Of attainable fields (ViewedFields), S is the ceiling of what is kept of the extinction: what an
 * optimisation of its own could show there at most, for the price of a score. Its slope is found
 * from four more of them.
 *
 * Ranks that share the fields keep their pieces as long as this is there, and all have to ask for
 * each score together, which they all get.
 */
class ViewScore
{
public:
  ViewScore(const Grid& grid, const ViewedFields& viewed, double rayDensity,
    BackendKind backend = BackendKind::Cpu);

  /// What computes, for the user.
  const std::string& BackendName() const { return this->Name; }

  /// The ranks that share the fields; null: there is one.
  const Communicator* Ranks() const { return this->All.get(); }

  /// May be called by several threads, unless ranks share the fields.
  Score At(const Camera& camera) const;

  /// S, from more samples at a `rayDensity` of two and more, and its derivative by the camera's
  /// position, from one sweep (Documentation/Method.md, section on viewpoints).
  ViewSlope SlopeAt(const Camera& camera) const;

private:
  ViewSlope DifferenceAt(const Camera& camera) const;

  std::shared_ptr<const Communicator> All;
  std::unique_ptr<const ViewFields> Fields; ///< where it is, whoever owns the scores
  double RayDensity;
  double Important; ///< the integral of importance times base extinction [length^2]
  std::string Name;
  std::unique_ptr<ScoreSweep> Sweep;
};
}

#endif
