// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Settings_h
#define limpid_optimize_Settings_h

#include "backend/Choice.h"
#include "energy/Derivative.h"
#include "energy/Score.h"
#include "methods/Method.h"
#include "scene/RaySource.h"

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace limpid
{
enum class SolverKind
{
  Policy, ///< policy sweeps, Documentation/Method.md
  Adam    ///< the paper's projected Adam, coarse to fine
};

enum class Mode
{
  Joint,   ///< one extinction for camera and light, Eqs. (22)-(24)
  Separate ///< one extinction for each, Section 4.2
};

/// Weights of the energy of Eq. (21), in normalised coordinates.
struct Weights
{
  double regularization = 1e-3; ///< p of Eq. (22)
  double view = 10;             ///< q of Eq. (23)
  double light = 1;             ///< r of Eq. (24)
};

/// Resolution of the grid on which the change of the extinction is found, see ControlGrid.
enum class ControlResolution
{
  FinestThatFits, ///< into Settings::memoryLimit
  Full,
  Half,
  Quarter
};

/// Filter applied to the importance for the optimisation. Scores always use the importance as
/// given.
enum class ImportanceSmoothing
{
  Off,
  Median ///< see Despeckle
};

/// The reference extinctions that a caller can give, SceneFields::references. Filters and displays
/// have one input array for each, from firstReferenceArray on.
enum class GivenReference
{
  Near, ///< see Settings::referencePull
  Count
};
constexpr std::size_t givenReferences = static_cast<std::size_t>(GivenReference::Count);
constexpr int firstReferenceArray = 4;

/// What the optimisation is to do. Members that a user can set are in the table
/// optimize/Settings.xml, which has their valid values.
struct Settings
{
  Method method = Method::Optimized;
  AmentWeights ament; ///< of Method::Ament2017

  Weights weights;

  /// Share of the visibility that must be at stake before a voxel of the majorant is cleared, >=
  /// 0. It is independent of density and size of the data (Documentation/Deviations.md, D23). If
  /// positive, it replaces weights.regularization; 0: that weight is used, as in the paper.
  double clearingThreshold = 0;

  Mode mode = Mode::Joint;
  SolverKind solver = SolverKind::Policy;
  int maximumIterations = 8;                               ///< of the policy, per camera
  std::array<int, 3> iterationsPerLevel{ { 32, 32, 64 } }; ///< Adam: at 1/4, 1/2 and full
                                                           ///< resolution
  double learningRate = 0.05;                              ///< of Adam [majorant]
  double tolerance = 1e-3;   ///< stops when the mean change is below [majorant]; policy: also below
                             ///< 5 times this, if the energy's change is below 0.1 times this
  double maximumSeconds = 0; ///< time limit; 0: none [s]
  Derivative derivative = Derivative::Volume;
  double rayDensity = 1;       ///< rays per voxel and axis on the farthest slice
  bool skipUnneeded = true;    ///< whether to skip what provably cannot change the result
  bool restrictToView = false; ///< whether only what is inside the view counts

  /// Share of the base extinction that important structures keep, times their importance [0, 1].
  /// 0: they may be removed, as in the paper.
  double protectImportance = 0;

  /// How far extinction may rise above the base, as a fraction of the way to the majorant [0, 1].
  /// 0: never denser than in the data; 1: up to the majorant, as in the paper.
  double emphasis = 1;

  ImportanceSmoothing importanceSmoothing = ImportanceSmoothing::Off;

  /// Strength of smoothing the changes between neighbours near the optimum, relative to the
  /// weights of view and light, see SmoothedChange [0, 10]. 0: none, as in the paper.
  double smoothness = 0;

  /// Strength of the pull towards the extinction found for a similar view or time step, relative
  /// to the weights of view and light (Documentation/Deviations.md, D20), >= 0. 0: none, as in the
  /// paper.
  double temporalCoherence = 0;

  /// Strength of the pull towards GivenReference::Near, relative to the weights of view and light,
  /// >= 0. 0: none, as in the paper.
  double referencePull = 0;

  /// Whether every iteration has a score, even if that costs an extra sweep, see
  /// Problem::tellsScores.
  bool scoreIterations = false;

  /// Further cameras that the extinction is optimised for: the view term of the energy and the
  /// scores are means over all cameras. Method::Optimized only.
  std::vector<Camera> otherCameras;

  BackendKind backend = BackendKind::Auto;

  // Used by owners of solvers, see ControlGrid; a solver itself has the grid that it is given.
  ControlResolution controlResolution = ControlResolution::FinestThatFits;
  double memoryLimit = 0; ///< of a process, beside the data [10^6 bytes]; 0: see AvailableMemory

  /// Throws limpid::Error if a value is invalid.
  void Require() const;
};

bool operator==(const Settings& one, const Settings& other);

/// Returns the values of all members but otherCameras.
std::vector<double> NumbersOf(const Settings& settings);

/// Returns the settings for several cameras, at least one: the first is the main one, the rest
/// become otherCameras.
Settings ForCameras(Settings settings, const std::vector<Camera>& cameras);

/// Whether iterations measure what scores measure, possibly with fewer rays: the camera has a
/// term, and the importance is used as given.
bool SeesWhatScoresAreOf(const Settings& settings);

/// Whether the light has an extinction of its own.
inline bool HasLightExtinction(const Settings& settings)
{
  const MethodInfo& info = InfoOf(settings.method);
  return info.iterates ? settings.mode == Mode::Separate : info.hasLightExtinction;
}

/// The three terms of Eq. (21), in world units: the normalised energy times R^2.
struct Energy
{
  double regularization = 0; ///< F_p, Eq. (22)
  double view = 0;           ///< F_q, Eq. (23)
  double light = 0;          ///< F_r, Eq. (24)
  double coherence = 0;      ///< F_t, Documentation/Deviations.md, D20
  double reference = 0;      ///< of the pull towards GivenReference::Near
  double Total() const { return regularization + view + light + coherence + reference; }
};

/// Number of terms beside those of Eq. (21). All of them are pulls.
constexpr std::size_t furtherTerms = sizeof(Energy) / sizeof(double) - 3;

/// The result of an iteration.
struct IterationRecord
{
  int iteration = 0; ///< 0 is the base extinction
  int level = 0;     ///< 0 full resolution, 1 half, 2 quarter
  Energy energy;
  Score score; ///< from the cameras; if it costs an extra sweep: 0, or with scoreIterations that
               ///< of the best so far
  double meanChange = 0; ///< mean |change| of voxels that may change [majorant]
  double seconds = 0;    ///< since the start
  bool isResult = false; ///< the best whatever its energy: it was smoothed, or the method
                         ///< minimises something else
};

/// Called after every iteration with the fraction of work done in [0, 1] and a text for the user.
/// If it returns false, the solver stops and keeps the best iterate so far.
using Progress = std::function<bool(double share, const std::string& text)>;

/// Returns the progress of a part of the work, from the share `begin` of it to `end`; empty if that
/// of all is.
Progress PartOf(const Progress& all, double begin, double end);
}

#endif
