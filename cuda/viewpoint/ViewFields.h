// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_ViewFields_h
#define limpid_viewpoint_ViewFields_h

#include "scene/Grid.h"
#include "scene/RaySource.h"
#include "scene/ScenePiece.h"
#include "sweep/PlanSweep.h"
#include "sweep/SlabDelivery.h"

#include <memory>
#include <vector>

namespace limpid
{
/// What views look at: one value per node each; the caller owns them.
struct ViewedFields
{
  const float* extinction;     ///< >= 0 [1/length]
  const float* importance;     ///< [0, 1]
  const float* base = nullptr; ///< base extinction [1/length]; null: the extinction is that
  std::shared_ptr<const ScenePiece> piece = nullptr; ///< null: the fields are of all nodes

  /// Whether every ray chooses its own extinction, from `least` to `extinction`, see CeilingKernel.
  bool attainable = false;
  const float* least = nullptr; ///< [1/length]; null: 0
};

/// Such fields as they are swept, and what is not empty of them.
struct SweptFields
{
  Grid grid;
  ViewedFields values;
  std::vector<float> extinction; ///< copies, if the values are that
  std::vector<float> importance;
  std::vector<float> base;
  std::vector<float> least;
  std::unique_ptr<const Occupancy> occupancy; ///< null: there is nothing to be seen
  std::unique_ptr<const HomeOfFields> home;   ///< where ranks have them; null: all are here
};

/**
 * Fields that are to be swept from many sides: cut to the box of what is not empty, and a second
 * time with the first and the last axis exchanged, so that no sweep reads across rows of memory.
 */
class ViewFields
{
public:
  /// The fields are copied, but for pieces of ranks.
  ViewFields(const Grid& grid, const ViewedFields& viewed);

  /// Nodes of the box of what is not empty, along each axis; 0 if all is.
  const Int3& Nodes() const { return this->Straight.grid.nodes; }

  /// Both forms.
  const SweptFields& InOrder() const { return this->Straight; }
  const SweptFields& WithAxesExchanged() const { return this->Exchanged; }

  /// A family of rays and the fields that it runs through.
  struct Part
  {
    const SweptFields* fields;
    PlannedFrustum frustum;
  };

  /// All rays of a camera, in view or not.
  std::vector<Part> PartsOf(const Camera& camera, double rayDensity) const;

private:
  SweptFields Straight;
  SweptFields Exchanged;
};
}

#endif
