// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_CarriedChange_h
#define limpid_optimize_CarriedChange_h

#include "optimize/Settings.h"
#include "scene/Grid.h"
#include "scene/RaySource.h"
#include "scene/ScenePiece.h"

#include <memory>
#include <vector>

namespace limpid
{
struct SceneFields;

/// The likeness of data to those of another time step, whose optimum moves with them: to stay as
/// near as to another view's costs more of the score (Documentation/Benchmarks/Steadiness.md).
constexpr double likenessInTime = 0.4;

/**
 * What an optimisation has made of a base extinction, so that it outlives that base: transfer
 * functions are edited, time goes on, and what was clear or opaque stays so.
 *
 *   mu = mu-bar + c mu-bar               where c < 0
 *   mu = mu-bar + c (majorant - mu-bar)  else
 */
struct CarriedChange
{
  Grid grid;
  std::vector<float> ofExtinction; ///< c, ValueCount() values in [-1, 1]; none: there is no change
  std::vector<float> ofLight;      ///< of the extinction for the light; empty: the same
  std::shared_ptr<const ScenePiece> piece; ///< what ranks have of it; null: one has all
  Camera camera;                           ///< for which it was found
  Light light;
  Settings settings;
  double likeness = 1; ///< of what it was found for to what is asked now, beside these [0, 1]

  bool Empty() const { return this->ofExtinction.empty() && !this->piece; }

  /// Number of values that are here.
  Index ValueCount() const
  {
    return this->piece ? this->piece->nodes.Count() : this->grid.NodeCount();
  }

  /// How much there is to stay near for another camera and light: the likeness for the same
  /// directions from the middle of the grid, 0 for directions more than 20 degrees away, and for
  /// other settings.
  double NearnessTo(
    const Camera& otherCamera, const Light& otherLight, const Settings& otherSettings) const;
};

/// Of a change that every rank has all of: what it is of a rank's piece of a scene.
CarriedChange OnPiece(
  CarriedChange change, const Grid& grid, const std::shared_ptr<const ScenePiece>& piece);

/// Of a change that ranks have pieces of: all of it on a coarser grid, on every rank.
CarriedChange ForAllRanks(CarriedChange change, const Grid& grid);

/// c of an extinction at so many nodes [1/length].
std::vector<float> ChangeOf(
  Index count, const float* base, const float* extinction, float majorant);

/// What a change makes of a scene, one value per node each [1/length].
struct CarriedExtinction
{
  std::vector<float> extinction; ///< empty: nothing
  std::vector<float> light;      ///< empty: the same

  /// Null: nothing.
  const float* Of(bool forLight) const
  {
    const std::vector<float>& values =
      forLight && !this->light.empty() ? this->light : this->extinction;
    return values.empty() ? nullptr : values.data();
  }
};

/// That of a scene with that majorant, whose grid may be finer or coarser than the change's;
/// nothing where it is over another box, or ranks share only one of both. Throws limpid::Error for
/// a change of another size than its grid.
CarriedExtinction AppliedTo(const SceneFields& scene, float majorant, const CarriedChange& change);
}

#endif
