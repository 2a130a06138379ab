// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_ViewFields_h
#define limpid_viewpoint_ViewFields_h

#include "scene/Grid.h"
#include "scene/RaySource.h"
#include "sweep/FieldSlabs.h"
#include "sweep/PlanOutline.h"

#include <memory>
#include <string>
#include <vector>

namespace limpid
{
struct ScenePiece;

/// The fields that views show, one value per node each; the caller owns them.
struct ViewedFields
{
  const float* extinction;     ///< >= 0 [1/length]
  const float* importance;     ///< [0, 1]
  const float* base = nullptr; ///< base extinction [1/length]; null if `extinction` is the base
  std::shared_ptr<const ScenePiece> piece = nullptr; ///< of the arrays; null: all nodes

  /// Whether every ray chooses its own extinction between `least` and `extinction`, see
  /// CeilingKernel.
  bool attainable = false;
  const float* least = nullptr; ///< [1/length]; null stands for 0
};

/// Fields in the form in which they are swept, with their occupancy.
struct SweptFields
{
  Grid grid;
  ViewedFields values;
  std::vector<float> extinction; ///< copies that `values` may refer to
  std::vector<float> importance;
  std::vector<float> base;
  std::vector<float> least;
  std::unique_ptr<const Occupancy> occupancy; ///< null if nothing can be seen
  std::unique_ptr<const FieldLayout> home;    ///< the distribution of `values`; null: copies
};

/**
 * Fields prepared for sweeps from many sides: cropped to the box of nonempty voxels, in the
 * original order and with the first and last axis exchanged. No sweep then has to read across rows
 * of memory.
 */
class ViewFields
{
public:
  /// Copies the fields, except in distributed runs.
  ViewFields(const Grid& grid, const ViewedFields& viewed);

  /// Whether other processes share the fields. Sweeps are then collective.
  bool AreShared() const;

  /// Returns whether a condition holds in any process that shares the fields. Collective.
  bool AnyOf(bool here) const;

  /// Describes a backend for the user, given the name of what computes in this process.
  std::string Describe(const std::string& backend) const;

  /// Returns the integral of importance times base extinction [length^2].
  double ImportantExtinction() const { return this->Important; }

  /// Number of nodes along each axis of the box of nonempty voxels; 0 if all voxels are empty.
  const Int3& Nodes() const { return this->Straight.grid.nodes; }

  /// Both orders of axes.
  const SweptFields& InOrder() const { return this->Straight; }
  const SweptFields& WithAxesExchanged() const { return this->Exchanged; }

  /// A set of rays and the fields that they cross.
  struct Part
  {
    const SweptFields* fields;
    PlannedFrustum outline; ///< see OutlineSweep
  };

  /// Returns all rays of a camera, inside the view or not.
  std::vector<Part> PartsOf(const Camera& camera, double rayDensity) const;

private:
  std::shared_ptr<const ScenePiece> Here;
  double Important;
  SweptFields Straight;
  SweptFields Exchanged;
};
}

#endif
