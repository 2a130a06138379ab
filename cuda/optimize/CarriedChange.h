// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_CarriedChange_h
#define limpid_optimize_CarriedChange_h

#include "optimize/FoundExtinction.h"
#include "optimize/Settings.h"
#include "scene/Grid.h"
#include "scene/RaySource.h"

#include <memory>
#include <optional>
#include <vector>

namespace limpid
{
struct SceneFields;
struct ScenePiece;

/// Likeness of data at different time steps. It is low because the optimum moves with the data.
/// Staying as near as between two views would cost more of the score
/// (Documentation/Benchmarks/Steadiness.md).
constexpr double likenessInTime = 0.4;

/**
 * The change that an optimisation has made to a base extinction, in a form that can be applied to
 * another base: after an edit of the transfer function, or at another time step, cleared voxels
 * stay clear and opaque ones opaque.
 *
 *    mu = mu-bar + c mu-bar if c < 0
 *
 *    mu = mu-bar + c (majorant - mu-bar) otherwise
 */
struct CarriedChange
{
  Grid grid;
  std::vector<float> ofExtinction; ///< c, ValueCount() values in [-1, 1]; empty: no change
  std::vector<float> ofLight; ///< c of the extinction for the light; empty: same as ofExtinction
  std::shared_ptr<const ScenePiece> piece; ///< subdomain of the values; null: all nodes
  Camera camera;                           ///< the camera for which the change was found
  Light light;
  Settings settings;
  double likeness = 1; ///< similarity of the data to the present data, apart from the above [0, 1]

  Index ValueCount() const; ///< number of values in this process

  /// Returns the weight of this change as a reference for another camera and light, in [0, 1]. It
  /// is the likeness if all directions from the centre of the grid are the same. It falls to 0 at
  /// an angle of 20 degrees, and is 0 for other settings.
  double NearnessTo(
    const Camera& otherCamera, const Light& otherLight, const Settings& otherSettings) const;
};

/// Returns a change in the decomposition of a scene, given one of which every process has all.
CarriedChange DistributedAs(const SceneFields& scene, CarriedChange change);

/// Returns all of a change in every process: a distributed one is resampled to a coarser grid.
CarriedChange Gathered(CarriedChange change, const Grid& coarser);

/// Computes c from an extinction at `count` nodes [1/length].
std::vector<float> ChangeOf(
  Index count, const float* base, const float* extinction, float majorant);

/// The extinction that results from a change at a node.
struct ChangedNode
{
  float majorant; ///< [1/length]

  /// `change`: c; `base`: of the node [1/length]; `importance`: of the node [0, 1].
  float operator()(float change, float base, float importance) const;
};

/// The extinctions that result from a change, one value per node each [1/length].
struct CarriedExtinction
{
  std::vector<float> extinction;
  std::vector<float> light; ///< of a separate extinction for the light
  bool hasLight = false;    ///< whether there is one

  /// Moves the values out.
  FoundExtinctions Take();
};

/// Applies a change to a scene with the given majorant. The grids may differ in resolution.
/// Returns nothing if the change is empty, if they cover different boxes, or if only one of the two
/// is distributed. Throws limpid::Error if the size of the change does not match its grid.
std::optional<CarriedExtinction> AppliedTo(
  const SceneFields& scene, float majorant, const CarriedChange& change);
}

#endif
