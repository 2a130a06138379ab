// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Progressive_h
#define limpid_optimize_Progressive_h

#include "energy/StructureLedger.h"
#include "optimize/CarriedChange.h"
#include "optimize/Solver.h"
#include "scene/OpaqueGeometry.h"

#include <memory>
#include <vector>

namespace limpid
{
/// The scores from a camera.
struct Scores
{
  Score base; ///< of the base extinction
  Score best; ///< of the found extinction
};

/// The shown extinctions in device memory [1/length].
struct ShownOnDevice
{
  ExtinctionOnDevice fields;
  const float* light = nullptr; ///< extinction for the light
};

/**
 * Optimises for a moving camera: quickly and coarsely while it moves, fully when it rests.
 *
 *    progressive.SetView(camera, light); // whenever one of them has changed
 *
 *    progressive.Preview(0.05); // while moving: once per frame
 *
 *    while (!progressive.Refine()) {} // at rest: once per frame, or all at once
 *
 * A refined result depends on camera, light and settings only, not on what was shown before,
 * unless Settings::temporalCoherence keeps it near that.
 */
class Progressive
{
public:
  /// The caller owns the fields. Throws limpid::Error like Solver.
  Progressive(const SceneFields& scene, const Settings& settings);
  ~Progressive();
  Progressive(Progressive&&) noexcept;
  Progressive& operator=(Progressive&&) noexcept;

  /// Shows the change of another scene over the same box until there is a new result. Ignores an
  /// empty change or one of another box. Call it before anything has been shown.
  void GoOnFrom(const CarriedChange& change);

  /// Returns the change that was found last, for another scene; empty if there is none yet.
  CarriedChange Change() const;

  /// Sets camera, light and settings. The previous result stays shown until there is a new one.
  /// Does nothing if all are unchanged. If they are invalid, throws limpid::Error and changes
  /// nothing.
  void SetView(const Camera& camera, const Light& light, const Settings& wanted);

  /// Performs one policy pass on the finest grid that is expected to take at most `seconds`. Does
  /// nothing if the shown result is at least as good for the current view. Processes that share the
  /// scene compute the same pass, on a grid small enough for each.
  void Preview(double seconds);

  /// Performs the next iteration at full resolution; the first call for a view only prepares.
  /// Previews stay shown until the first iteration. Returns whether nothing is left to do. If the
  /// first call throws, nothing has changed. After an exception from a later call or from Preview,
  /// this object must not be used any more.
  bool Refine();

  /// Shows the base extinction instead of an extinction that shows less of the important
  /// structures, until there is a new result. That may be one kept from another view or scene, a
  /// preview, or an unfinished iterate; the final result always stays. Call it once per frame. It
  /// takes no sweeps beyond those for the scores of the frame. The refused extinction is not lost:
  /// it remains the reference of the next one, and another scene may go on from it.
  void ShowNoLessThanBase();

  /// Whether a result is shown, for this scene or another one; otherwise the base extinction is.
  bool ShowsFound() const;

  bool HasBegun() const;  ///< whether Refine was called for the current view
  bool Converged() const; ///< whether Refine has finished for the current view
  bool Settled() const;   ///< false if Refine finished because of a limit, see Solver::Settled

  /// The grid of the shown extinction: it covers the box of the scene's grid, or that of this
  /// process's subdomain. Valid after Preview or Refine.
  const Grid& ShownGrid() const;
  bool ShowsPiece() const;              ///< whether ShownGrid() is that of a subdomain
  const float* BaseExtinction() const;  ///< at the nodes of ShownGrid() [1/length]
  const float* Extinction() const;      ///< at the nodes of ShownGrid() [1/length]
  const float* LightExtinction() const; ///< the same array in joint mode

  /// The shown extinctions on a device, valid until the next step; null pointers if they are on
  /// the host. Nothing is downloaded.
  ShownOnDevice OnDevice() const;

  Score BaseScore() const;
  Score BestScore() const;

  /// Scores of the base and of the shown extinction from another camera; costs one sweep each.
  /// Valid after Preview or Refine. `opaque`: geometry that ends the rays, so that the scores are
  /// those of what is in front of it; null if there is none.
  Scores ScoresFrom(const Camera& camera, const OpaqueGeometry* opaque = nullptr) const;

  /// The highest score possible from a camera within the bounds of the current settings, see
  /// Ceiling. Costs a sweep, and another one for the light. Valid after SetView. Zeros for a
  /// method without iterations. `opaque`: as in ScoresFrom.
  Ceiling CeilingFrom(const Camera& camera, const OpaqueGeometry* opaque = nullptr) const;

  /// Returns what cameras see of each structure in the mean, see SharesOfStructures. `rows`: row of
  /// the structure of each node; `extinction`: BaseExtinction() or Extinction(). `opaque`: as in
  /// ScoresFrom, but shares are of all that the data have. Empty while a preview is shown, which
  /// has other nodes. Collective.
  std::vector<StructureShares> SharesFrom(const std::vector<Camera>& cameras,
    const Structures& structures, const StructureRow* rows, const float* extinction,
    const OpaqueGeometry* opaque = nullptr) const;

  int Iterations() const; ///< at full resolution, for the current view
  std::string BackendName() const;

private:
  CarriedChange ChangeWithoutValues() const;
  CarriedChange FoundChange() const;
  const float* FoundForCamera() const;
  const float* FoundForLight() const;
  ExtinctionInPlace FoundInPlace(bool onGpu) const;
  Score FoundScore() const;
  bool IsJudged() const;
  bool StaysNear() const;
  const Scores& KeptScores() const;
  Scores ScoresWith(
    const Camera& camera, const Settings& settings, const OpaqueGeometry* opaque = nullptr) const;

  struct Internals;
  std::unique_ptr<Internals> State;
};
}

#endif
