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
#include <functional>
#include <string>
#include <vector>

namespace limpid
{
struct Settings;

/// What of some settings ranks cannot do together yet, "the method Viola2004", say; empty: they can
/// do all.
std::string NotOnRanks(const Settings& settings);

/// Settings for ranks that share a scene: on processors. Throws limpid::Error when these cannot do
/// together what is wanted.
Settings ForRanks(Settings settings);

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

/// What is done to the importance before the optimisation, which minimises the energy of what comes
/// of it. Scores are always those of the importance as given.
enum class ImportanceSmoothing
{
  Off,
  Median ///< see Despeckle
};

using WeightOf = double Weights::*;

/// A weight, and what to tell whoever sets it below zero.
struct WeightInfo
{
  WeightOf weight;
  const char* name;
  const char* whyNotNegative;
};

/// All weights.
inline constexpr WeightInfo allWeights[] = {
  { &Weights::regularization, "regularization weight",
    "the energy of Eq. (21) would have no minimum" },
  { &Weights::view, "view weight", "important structures would be hidden on purpose" },
  { &Weights::light, "light weight", "important structures would be darkened on purpose" },
};

struct Settings
{
  Method method = Method::Optimized;
  AmentWeights ament; ///< of Method::Ament2017

  Weights weights;

  /// Share of the visibility that must be at stake before a voxel of the densest matter is cleared,
  /// whatever the density and the size of the data (Documentation/Deviations.md, D23), >= 0. It
  /// takes the place of weights.regularization; 0: that counts, as in the paper.
  double clearingThreshold = 0;

  Mode mode = Mode::Joint;
  SolverKind solver = SolverKind::Policy;
  int maximumIterations = 8;                               ///< policy, for every camera
  std::array<int, 3> iterationsPerLevel{ { 32, 32, 64 } }; ///< Adam: quarter, half, full resolution
  double learningRate = 0.05;                              ///< Adam [majorant]
  double tolerance = 1e-3;   ///< stop when the mean change of an iteration is below [majorant];
                             ///< policy: or below 5 times this, the energy's below a tenth of it
  double maximumSeconds = 0; ///< stop after; zero: no limit [s]
  Derivative derivative = Derivative::Volume;
  double rayDensity = 1;       ///< rays per voxel and axis on the farthest slice
  bool skipUnneeded = true;    ///< leave out what provably cannot change the result
  bool restrictToView = false; ///< count only what the picture shows

  /// Share of its base extinction that important matter keeps, times its importance [0, 1]; 0: it
  /// may be removed, as in the paper.
  double protectImportance = 0;

  /// How far above its base extinction matter may become, as a share of the way to the majorant
  /// [0, 1]; 0: matter never becomes thicker than in the data; 1: it may rise to the majorant, as
  /// in the paper.
  double emphasis = 1;

  ImportanceSmoothing importanceSmoothing = ImportanceSmoothing::Off;

  /// How strongly the changes of neighbours are drawn together when the optimum is near, as a share
  /// of the weights of view and light, see SmoothedChange [0, 10]; 0: not at all, as in the paper.
  double smoothness = 0;

  /// How strongly the extinction is drawn to what was found for a near view or time step before, as
  /// a share of the weights of view and light (Documentation/Deviations.md, D20), >= 0; 0: what
  /// was before does not matter, as in the paper.
  double temporalCoherence = 0;

  /// Whether every iteration has a score, also where that takes a sweep of its own, see
  /// Problem::tellsScores.
  bool scoreIterations = false;

  /// Cameras for which the extinction is to be as good as for the camera itself: the energy's view
  /// term and scores are means over all of them. Method::Optimized only.
  std::vector<Camera> otherCameras;

  BackendKind backend = BackendKind::Auto;

  /// Throws limpid::Error on a value that cannot be worked with.
  void Require() const;
};

bool operator==(const Settings& one, const Settings& other);

/// Settings for the first of several cameras, one at least, and as much for the others.
Settings ForCameras(Settings settings, const std::vector<Camera>& cameras);

/// Whether iterations see what the scores are of, but maybe by fewer rays: the camera has a term,
/// and the importance is as given.
bool SeesWhatScoresAreOf(const Settings& settings);

/// Whether there is another extinction for the light than for the camera.
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
  double Total() const { return regularization + view + light + coherence; }
};

/// What an iteration ended with.
struct IterationRecord
{
  int iteration = 0; ///< 0 is the base extinction
  int level = 0;     ///< 0 full resolution, 1 half, 2 quarter
  Energy energy;
  Score score;           ///< from the cameras; 0 where it takes a sweep of its own and nobody
                         ///< has asked, see Settings::scoreIterations; then of the best so far
  double meanChange = 0; ///< mean |change| of the voxels that may change [majorant]
  double seconds = 0;    ///< since the start
  bool isResult = false; ///< the best, whatever its energy: it drew neighbours together, or is what
                         ///< a method makes that minimises something else
};

/// Told after every iteration: share of the work done in [0, 1] and a text for the user.
/// Returns false to stop: the solver then keeps the best iterate so far.
using Progress = std::function<bool(double share, const std::string& text)>;
}

#endif
