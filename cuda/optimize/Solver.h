// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Solver_h
#define limpid_optimize_Solver_h

#include "optimize/CarriedChange.h"
#include "optimize/FoundExtinction.h"
#include "optimize/Settings.h"
#include "scene/Grid.h"
#include "scene/RaySource.h"
#include "scene/ScenePiece.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace limpid
{
/// The fields of a scene; the caller owns the arrays and keeps them while a solver uses them.
struct SceneFields
{
  Grid grid;
  const float* baseExtinction = nullptr; ///< grid.NodeCount() values >= 0, finite [1/length]
  const float* importance = nullptr;     ///< grid.NodeCount() values in [0, 1]

  /// What the extinction may rise to, Eq. (25): the largest extinction of the transfer function, so
  /// that it depends neither on time nor on what is cropped away. Never below the largest value of
  /// the base extinction, which it is by default [1/length].
  float majorant = 0;

  /// The importance without its specks, likewise, for ImportanceSmoothing::Median; null: it is made
  /// of the importance when it is asked for.
  const float* despeckled = nullptr;

  /// The part that the arrays have, where ranks share the scene: they have its nodes' values alone,
  /// first axis fastest. Null: they have all.
  std::shared_ptr<const ScenePiece> piece = nullptr;

  /// Number of values in the arrays.
  Index ValueCount() const
  {
    return this->piece ? this->piece->nodes.Count() : this->grid.NodeCount();
  }
};

class PreparedScene;

/**
 * Finds the extinction that minimises Eq. (21) for one camera and one light.
 *
 * Iterations can be spread over frames: each Step continues where the last one ended. Whatever
 * happens in between, Extinction() is the best iterate so far, and every value lies within
 * its bounds (ExtinctionBounds). Voxels that no important structure needs keep their base
 * extinction bit by bit.
 */
class Solver
{
public:
  /// `previous`: what the extinction is to stay near with Settings::temporalCoherence; nothing if
  /// it is of another box. Throws limpid::Error when the scene or the settings cannot be worked
  /// with.
  Solver(const SceneFields& scene, const Camera& camera, const Light& light,
    const Settings& settings, const CarriedChange& previous = {});

  /// The same for a scene that has been checked before and may be shared.
  Solver(std::shared_ptr<PreparedScene> scene, const Camera& camera, const Light& light,
    const Settings& settings, const CarriedChange& previous = {});
  ~Solver();
  Solver(Solver&&) noexcept;
  Solver& operator=(Solver&&) noexcept;

  /// Starts from this extinction instead of the base extinction: grid.NodeCount() values, moved
  /// into their bounds [1/length]. Joint mode only.
  void SetInitialExtinction(const float* extinction);

  /// Runs up to `iterations` further iterations. Returns whether there is nothing left to do:
  /// converged, or iterations or time used up, or stopped by `progress`. After an exception, the
  /// solver is of no more use; the scene is.
  bool Step(int iterations, const Progress& progress = {});

  /// Step until there is nothing left to do.
  void Run(const Progress& progress = {});

  bool Done() const;
  bool Stopped() const; ///< whether `progress` asked to stop

  /// Whether every run ended because another iteration would change next to nothing; else it was a
  /// limit, of iterations or time, or `progress`.
  bool Settled() const;

  /// Best iterate so far, grid.NodeCount() values [1/length].
  const std::vector<float>& Extinction() const;

  /// The extinction for the light, where there is one (HasLightExtinction) [1/length]; else empty.
  const std::vector<float>& LightExtinction() const;

  /// What was made of the base extinction, for another scene.
  CarriedChange Change() const;

  /// Whether these are better than what the iterations start from, or all there is to be found.
  bool HasResult() const;

  /// Where a device has both, until the next step; nulls: it has not.
  ExtinctionOnDevice OnDevice() const;
  ExtinctionOnDevice LightOnDevice() const;

  /// Both extinctions, given away: the solver cannot be used any more.
  std::array<FoundExtinction, 2> TakeExtinctions();

  /// Whether the records have scores; between the first and the last these are by the rays of
  /// iterations. BestScore() is always that of the importance as given.
  bool TellsScores() const;

  double Majorant() const; ///< upper bound of the extinction, Eq. (25) [1/length]

  Score BaseScore() const; ///< of the base extinction
  Score BestScore() const; ///< of Extinction()
  /// What no extinction within the bounds exceeds, nor what was found: found by the first call. Of
  /// the importance as given, like scores. Zeros for a method that does not iterate.
  Ceiling FindCeiling() const;

  /// What no energy is below, of any extinction within the bounds [length^2]. A sweep of each view
  /// and the light.
  double LeastEnergy() const;

  Energy BestEnergy() const;
  int Iterations() const;
  double Seconds() const;
  const std::vector<IterationRecord>& History() const; ///< all iterations, first the base

  /// What computes: "CPU, 2 threads", or where ranks share the scene "…, on each of 4 ranks".
  std::string BackendName() const;

  /// Transmittance from the camera to every voxel through Extinction(), Eq. (15);
  /// `transmittance` has room for grid.NodeCount() values in [0, 1].
  void Transmittance(float* transmittance) const;

  /// Transmittance from the light, Eq. (16), through LightExtinction() where there is one.
  void LightTransmittance(float* transmittance) const;

private:
  struct Internals;
  std::unique_ptr<Internals> State;
};
}

#endif
