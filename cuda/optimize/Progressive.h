// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Progressive_h
#define limpid_optimize_Progressive_h

#include "optimize/CarriedChange.h"
#include "optimize/PassTime.h"
#include "optimize/Solver.h"
#include "scene/OpaqueGeometry.h"

#include <memory>

namespace limpid
{
/// What a camera sees.
struct Scores
{
  Score base; ///< of the base extinction
  Score best; ///< of what was found
};

/// What is shown, in the memory of the device that has found it [1/length].
struct ShownOnDevice
{
  ExtinctionOnDevice fields;
  const float* light = nullptr; ///< the extinction for the light
};

/**
 * Optimises for a camera that moves: quickly and coarsely while it does, fully when it rests.
 *
 *   progressive.SetView(camera, light);  // whenever one of them has changed
 *   progressive.Preview(0.05);           // while moving: once per frame
 *   while (!progressive.Refine()) {}     // at rest: once per frame, or all at once
 *
 * A refined result depends on camera, light and settings alone, not on what was shown before,
 * unless Settings::temporalCoherence is to keep it near that.
 */
class Progressive
{
public:
  /// The fields stay with the caller. Throws limpid::Error as Solver does.
  Progressive(const SceneFields& scene, const Settings& settings);
  ~Progressive();
  Progressive(Progressive&&) noexcept;
  Progressive& operator=(Progressive&&) noexcept;

  /// Another stopwatch for previews; for tests.
  void SetStopwatch(Stopwatch stopwatch);

  /// Shows what another scene over the same box found, until there is something new. Does nothing
  /// for a change that is empty or of another box. Nothing may have been shown yet.
  void GoOnFrom(const CarriedChange& change);

  /// What was found last, for another scene; empty: nothing yet.
  CarriedChange Change() const;

  /// A new camera, light or new settings. What was found before stays shown until there is
  /// something new. Nothing happens if all are the same as before. Throws limpid::Error, and
  /// changes nothing, when they cannot be worked with.
  void SetView(const Camera& camera, const Light& light, const Settings& settings);

  /// One policy pass on the finest grid on which it is expected to take no longer. Does nothing if
  /// what is shown is at least as good for the present view. Where ranks share the scene, each
  /// makes the same pass, on a grid of which it can have all.
  void Preview(double seconds);

  /// The next iteration at full resolution; the first call for a view only prepares. Previews stay
  /// shown until the first iteration. Returns whether there is nothing left to do. An exception
  /// from the first call changes nothing; after one from another call or from Preview, this object
  /// is of no more use.
  bool Refine();

  /// Shows the base extinction in place of what shows less of the important structures than that
  /// does, until there is something new: what was kept from another view or scene, a preview, an
  /// iterate that is on its way. What the solver ends at stays. To be called once per frame; takes
  /// no sweeps that the scores of the frame do not take anyway. What was found is not lost: the
  /// next extinction stays near it, and another scene goes on from it.
  void ShowNoLessThanBase();

  /// Whether anything is shown that was found, for this scene or another one; else the base is.
  bool ShowsFound() const;

  bool HasBegun() const;  ///< whether Refine was called for the present view
  bool Converged() const; ///< whether Refine has nothing left to do for the present view
  bool Settled() const;   ///< false: it has for a limit, if it has, see Solver::Settled

  /// What is to be shown now: the same box as the scene's grid, or as this rank's piece of it.
  /// Valid after Preview or Refine.
  const Grid& ShownGrid() const;
  bool ShowsPiece() const;              ///< whether that is a rank's piece
  const float* BaseExtinction() const;  ///< at the nodes of ShownGrid() [1/length]
  const float* Extinction() const;      ///< at the nodes of ShownGrid() [1/length]
  const float* LightExtinction() const; ///< the same array in joint mode

  /// The same where a device has it, until the next step; nulls: it is on the host. Nothing needs
  /// to come from the device for it.
  ShownOnDevice OnDevice() const;

  Score BaseScore() const;
  Score BestScore() const;

  /// What another camera sees of the base extinction and of what is shown: a sweep each. Valid
  /// after Preview or Refine. `opaque`: ends its rays, and the scores are those of what is in
  /// front; null: nothing does.
  Scores ScoresFrom(const Camera& camera, const OpaqueGeometry* opaque = nullptr) const;

  /// What a camera could see at most within the bounds of the present settings, see Ceiling: a
  /// sweep, and another one of the light. Valid after SetView. Zeros for a method that does not
  /// iterate. `opaque`: likewise.
  Ceiling CeilingFrom(const Camera& camera, const OpaqueGeometry* opaque = nullptr) const;

  int Iterations() const; ///< at full resolution, for the present view
  std::string BackendName() const;

private:
  CarriedChange FoundChange() const;
  const float* FoundForCamera() const;
  const float* FoundForLight() const;
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
