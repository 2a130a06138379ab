// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Solver_h
#define limpid_optimize_Solver_h

#include "energy/StructureLedger.h"
#include "optimize/CarriedChange.h"
#include "optimize/FoundExtinction.h"
#include "optimize/SceneFields.h"
#include "optimize/Settings.h"
#include "scene/RaySource.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace limpid
{
class PreparedScene;

/**
 * Finds the extinction that minimises Eq. (21) for one camera and one light.
 *
 * Iterations can be spread over frames: each Step continues where the last one ended. Extinction()
 * is always the best iterate so far, and every value lies within its bounds (ExtinctionBounds).
 * Voxels that no important structure depends on keep their base extinction bit by bit.
 */
class Solver
{
public:
  /// `previous`: the reference for Settings::temporalCoherence; ignored if it covers another box.
  /// Throws limpid::Error if the scene or the settings are invalid.
  Solver(const SceneFields& scene, const Camera& camera, const Light& light,
    const Settings& settings, const CarriedChange& previous = {});

  /// Uses a scene that has been checked already and may be shared.
  /// `found`: the extinctions that `previous` led to, if that was in this scene; its values are not
  /// read then.
  Solver(std::shared_ptr<PreparedScene> scene, const Camera& camera, const Light& light,
    const Settings& settings, const CarriedChange& previous = {},
    const FoundExtinctions& found = {});

  /// Measures an extinction: Run makes no iterations, whatever the settings say.
  Solver(std::shared_ptr<PreparedScene> scene, const Camera& camera, const Light& light,
    const Settings& settings, CarriedExtinction&& measured);
  ~Solver();
  Solver(Solver&&) noexcept;
  Solver& operator=(Solver&&) noexcept;

  /// Starts from this extinction instead of the base extinction: grid.NodeCount() values, clamped
  /// to their bounds [1/length]. `light`: that for the light, which separate mode needs.
  void SetInitialExtinction(const float* extinction, const float* light = nullptr);

  /// Runs up to `iterations` more iterations. Returns whether nothing is left to do: converged,
  /// out of iterations or time, or stopped by `progress`. After an exception the solver must not
  /// be used any more; the scene stays valid.
  bool Step(int iterations, const Progress& progress = {});

  /// Runs until nothing is left to do.
  void Run(const Progress& progress = {});

  bool Done() const;
  bool Stopped() const; ///< whether `progress` asked to stop

  /// Whether every run ended by convergence, not by a limit of iterations or time or by
  /// `progress`.
  bool Settled() const;

  /// Best iterate so far, grid.NodeCount() values [1/length].
  const std::vector<float>& Extinction() const;

  /// Its values, possibly without a copy; valid until the next step.
  const float* ExtinctionValues() const;

  /// The separate extinction for the light (HasLightExtinction) [1/length]; else empty.
  const std::vector<float>& LightExtinction() const;
  const float* LightExtinctionValues() const; ///< likewise

  /// Returns the change of the base extinction, for another scene.
  CarriedChange Change() const;

  /// Whether the extinctions are better than the start of the iterations, or final.
  bool HasResult() const;

  /// The extinctions on a device, valid until the next step; null pointers if they are on the
  /// host.
  ExtinctionOnDevice OnDevice() const;
  ExtinctionOnDevice LightOnDevice() const;

  /// Moves both extinctions out; the solver must not be used afterwards.
  std::array<FoundExtinction, 2> TakeExtinctions();

  double Majorant() const; ///< upper bound of the extinction, Eq. (25) [1/length]

  Score BaseScore() const; ///< of the base extinction
  Score BestScore() const; ///< of Extinction()
  /// Returns an upper bound of the scores of all extinctions within the bounds, computed by the
  /// first call. Like scores, it uses the importance as given. Zeros for a method without
  /// iterations.
  Ceiling FindCeiling() const;

  /// Returns what the cameras see of each structure through Extinction(), see SharesOfStructures.
  /// `rows`: row of the structure of each node.
  std::vector<StructureShares> SharesOf(
    const Structures& structures, const StructureRow* rows) const;

  Energy BestEnergy() const;
  int Iterations() const;
  double Seconds() const;
  const std::vector<IterationRecord>& History() const; ///< all iterations, starting with the base

  // What it was made for.
  const Camera& MainCamera() const;
  const Light& OnlyLight() const;
  const Settings& Options() const;

  /// Describes the backend for the user: "CPU, 2 threads".
  std::string BackendName() const;

  /// Computes the transmittance from the camera to every voxel through Extinction(), Eq. (15).
  /// `transmittance`: grid.NodeCount() values in [0, 1].
  void Transmittance(float* transmittance) const;

  /// Computes the transmittance from the light, Eq. (16), through LightExtinction() if there is
  /// one.
  void LightTransmittance(float* transmittance) const;

private:
  struct Internals;
  std::unique_ptr<Internals> State;
};
}

#endif
