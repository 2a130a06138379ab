// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_PreparedScene_h
#define limpid_optimize_PreparedScene_h

#include "optimize/Problem.h"
#include "optimize/Solver.h"
#include "scene/NodeValues.h"

namespace limpid
{
/// Throws limpid::Error unless settings can be worked with in this build.
void RequireSettings(const Settings& settings);

/// Throws limpid::Error unless the rays of both can be told apart.
void RequireReach(const Problem& problem);

/// Whether a problem's iterations have as many rays as scores, and resolve layers as these do.
bool IsSampledAsScores(const Problem& problem);

/// Throws limpid::Error unless camera and light can be worked with.
void RequireView(
  const Camera& camera, const Light& light, const Settings& settings, const Grid& grid);

/**
 * A scene whose values have been checked, with all that follows from them alone: what stays when
 * camera, light and weights change.
 */
class PreparedScene
{
public:
  /// Throws limpid::Error when the scene cannot be worked with.
  explicit PreparedScene(const SceneFields& scene);

  const Grid& Nodes() const { return this->Fields.grid; }
  const SceneFields& Arrays() const { return this->Fields; }
  float Majorant() const { return this->LargestExtinction; } ///< Eq. (25) [1/length]

  /// Whether an extinction can show anything at all: there is a volume, and something important.
  bool SomethingToSee() const;

  /// The energy as seen from a camera and lit by a light; null-weighted terms stay in it.
  Problem ProblemFor(const Camera& camera, const Light& light, const Settings& settings);

  /// A problem for scores and ceilings, which the importance as given counts for. In small volumes
  /// and thick media they take more rays than iterations, and layers are resolved by FineCuts where
  /// any may be thick.
  Problem ProblemForScores(const Camera& camera, const Light& light, const Settings& settings);

  /// What a problem of this scene is to stay near of a change, moved into its bounds; sets how
  /// near. Nothing where that does not count.
  CarriedExtinction StayedNear(
    const CarriedChange& before, const Camera& camera, const Light& light, Problem& problem) const;

  /// The importance that the energy counts, grid.NodeCount() values [0, 1].
  const float* ImportanceFor(ImportanceSmoothing smoothing);

private:
  /// An importance, and what follows from it.
  struct Important
  {
    const float* values = nullptr; ///< [0, 1]
    NodeValues own;                ///< where they are nobody else's
    NodeValues ofNodes;            ///< see NodeImportanceOfFilled
    std::shared_ptr<const Occupancy> occupancy;
    std::shared_ptr<Resident> resident = std::make_shared<Resident>();
  };

  Important& ImportantFor(ImportanceSmoothing smoothing);

  SceneFields Fields;
  float LargestExtinction = 0;
  bool SomethingImportant = false;
  Important Given;
  std::unique_ptr<Important> Despeckled; ///< null: nobody has asked
};
}

#endif
