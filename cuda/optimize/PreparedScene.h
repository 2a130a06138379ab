// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_PreparedScene_h
#define limpid_optimize_PreparedScene_h

#include "optimize/CarriedChange.h"
#include "optimize/Problem.h"
#include "optimize/SceneFields.h"
#include "scene/NodeValues.h"

#include <memory>
#include <vector>

namespace limpid
{
/// Returns the rays per voxel and axis for scores, with a minimum number of rays across the
/// volume, so that enough rays meet the visible structures. In thick media a ray shows only the
/// first surface that it meets.
double RayDensityOfScores(const Problem& problem);

/// Throws limpid::Error if settings are invalid or not supported by this build.
void RequireSettings(const Settings& settings);

/// Throws limpid::Error if two neighbouring rays of the camera or the light cannot be
/// distinguished.
void RequireReach(const Problem& problem);

/// Whether a problem's iterations have as many rays as scores and resolve layers likewise.
bool IsSampledAsScores(const Problem& problem);

/// Throws limpid::Error if camera or light are invalid.
void RequireView(
  const Camera& camera, const Light& light, const Settings& settings, const Grid& grid);

/**
 * A scene whose values have been checked, with all data derived from them. It does not depend on
 * camera, light and weights.
 */
class PreparedScene
{
public:
  /// Throws limpid::Error if the scene is invalid.
  explicit PreparedScene(const SceneFields& given);

  /// Makes it. If that fails here, the other processes that share the scene are told.
  static std::shared_ptr<PreparedScene> Make(const SceneFields& given);

  const Grid& Nodes() const { return this->Fields.grid; }
  const SceneFields& Arrays() const { return this->Fields; } ///< with a decomposition
  const Grid& ArrayGrid() const { return this->OfArrays; }   ///< of the nodes in the arrays
  const ScenePiece& Piece() const { return *this->Fields.piece; }
  float Majorant() const { return this->LargestExtinction; } ///< Eq. (25) [1/length]

  // The following are collective: all processes that share the scene call them.

  /// Returns whether a condition holds in any process.
  bool AnyOf(bool here) const { return this->Piece().ranks->AnyOf(here); }

  /// Returns the maximum of a non-negative number over all processes.
  float LargestOf(float here) const { return this->Piece().ranks->LargestOf(here); }

  /// Runs collective work. If it fails here, the other processes are told.
  template <class Work>
  decltype(auto) Together(const Work& work) const
  {
    return NotifyingOnFailure(*this->Piece().ranks, work);
  }

  /// Whether any extinction can show something: the volume is not empty, and something is
  /// important.
  bool SomethingToSee() const;

  /// Returns the energy for a camera and a light. Terms of weight 0 are included.
  Problem ProblemFor(const Camera& camera, const Light& light, const Settings& settings);

  /// Returns a problem for scores and ceilings, which use the importance as given. In small
  /// volumes and thick media it has more rays than iterations. Layers are resolved by FineCuts if
  /// any may be thick.
  Problem ProblemForScores(const Camera& camera, const Light& light, const Settings& settings);

  /// Returns a problem for scores with as many rays as iterations have.
  Problem ProblemForScoresOfIterates(
    const Camera& camera, const Light& light, const Settings& settings);

  /// Returns a problem whose energy and bounds are wanted, and no derivatives.
  Problem ProblemForEnergy(const Camera& camera, const Light& light, const Settings& settings)
  {
    return this->MakeProblem(camera, light, settings, false);
  }

  /// Frees the node importance, which is computed again when a problem to be minimised needs it.
  void FreeNodeImportance();

  /// Frees all fields that can be computed again.
  void FreeDerivedFields();

  /// Returns all pulls of a problem but the regularisation, with references within its bounds.
  /// `before`: the change that temporal coherence pulls to; `found`: see Solver.
  std::vector<PullWithReferences> PullsFor(const CarriedChange& before, const Problem& problem,
    const Camera& camera, const Light& light, const FoundExtinctions& found = {}) const;

  /// Returns the importance in the energy, one value per node of the arrays [0, 1].
  const float* ImportanceFor(ImportanceSmoothing smoothing);

  /// Returns the lower bound of the extinction, see ExtinctionBounds, one value per node of the
  /// arrays [1/length]; empty if it is 0.
  NodeValues LeastExtinction(const Settings& settings);

private:
  /// An importance and data derived from it.
  struct Important
  {
    const float* values = nullptr; ///< [0, 1]; null: freed
    DerivedFields derived;         ///< `values`, unless the caller owns them, and what is of nodes
    std::shared_ptr<const Occupancy> occupancy;
    std::shared_ptr<Resident> resident = std::make_shared<Resident>();
  };

  /// `minimised`: whether its node importance is needed.
  Important& ImportantFor(ImportanceSmoothing smoothing, bool minimised);
  void FreeNodesOf(Important& important) const;
  void Despeckle(Important& important) const;
  Problem MakeProblem(
    const Camera& camera, const Light& light, const Settings& settings, bool minimised);
  std::shared_ptr<const Occupancy> OccupancyOf(Important& important, bool skip) const;
  std::shared_ptr<const NodeValues> NodeImportanceOf(const Important& important) const;

  SceneFields Fields;
  Grid OfArrays;
  float LargestExtinction = 0;
  bool SomethingImportant = false;
  Important Given;
  std::unique_ptr<Important> Despeckled; ///< null until it is requested first
};
}

#endif
