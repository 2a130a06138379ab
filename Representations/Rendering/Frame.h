// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A frame of a volume in a view: its settings, its time and its results.

#ifndef limpid_Frame_h
#define limpid_Frame_h

#include "PictureBackend.h"
#include "SceneLight.h"

#include "distributed/Communicator.h"
#include "optimize/Solver.h"
#include "render/Renderer.h"
#include "scene/ViewSet.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <string>
#include <vector>

namespace limpid
{
/// Settings of a frame.
struct FrameSettings
{
  bool still = true;    ///< off: a frame during interaction, with limited time
  bool optimize = true; ///< off: show the extinction of the transfer functions
  bool measure = true;  ///< off: no scores
  bool once = false;    ///< optimise for the camera of the first still frame only
  bool paused = false;  ///< keep the extinction
  Settings solver;
  ViewSet views;     ///< the cameras that share an extinction
  ChosenLight light; ///< in data coordinates
  Lighting lighting; ///< except for the light itself and whether it is on
  bool lit = true;
  double sampleDistance = 1;
  bool jitter = false;
  DrawOn drawOn = DrawOn::Auto;
  bool showMissed = false; ///< paint over what misses important structures
  std::array<float, 3> missedColor{ { 1, 0, 1 } };
  double structureColors = 0; ///< share of the colours of structures in those of samples [0, 1]
  std::vector<std::array<float, 3>> colorsOfRows; ///< of structures, from row 1 on
  double frameTime = 0.1;                         ///< time limit of a frame during interaction [s]
  double easeTime = 0.3; ///< time constant of changes during interaction [s]
  bool stepwise = false; ///< still frames make one step of the optimisation only

  const Communicator* ranks = ThisProcess().get(); ///< those that draw the frame together

  bool IsOfSeveral() const { return !this->ranks->IsAlone(); }

  /// Returns whether `here` is true on any rank.
  bool AnyRank(bool here) const { return this->ranks->AnyOf(here); }

  /// Returns the largest value of all ranks, so that they take the same decision; values are at
  /// least zero.
  double Largest(double here) const { return this->ranks->LargestOf(static_cast<float>(here)); }

  /// Returns how pictures are composed of samples; it is front to back unless a method needs
  /// importance.
  Compositing Composing() const
  {
    return this->optimize ? InfoOf(this->solver.method).compositing : Compositing::FrontToBack;
  }

  /// Returns whether rays read the importance.
  bool DrawsImportance() const
  {
    return this->showMissed || this->Composing() != Compositing::FrontToBack;
  }

  bool CastsShadows() const { return !this->optimize || InfoOf(this->solver.method).castsShadows; }

  /// Returns whether pictures show another extinction than that of the transfer functions.
  bool ShowsExtinction() const
  {
    return this->optimize && this->Composing() == Compositing::FrontToBack;
  }
};

/// Results of a frame.
struct FrameResult
{
  bool measured = false; ///< whether scores were measured in this frame; if not, they are 0
  bool optimized = true; ///< whether the score is that of the optimised extinction
  Score score;
  Score baseScore;
  Ceiling ceiling; ///< 0 if unknown: during interaction and before convergence
  bool converged = true;
  bool settled = true; ///< whether the optimisation converged before its limits
  int iterations = 0;
  std::string light;
  std::string backend;
  std::string optimizedAt; ///< resolution of the optimisation; empty: that of the data
  std::string drawnBy;     ///< see PictureBackend
  Index uploadedBytes = 0; ///< see PictureBackend
  std::string warning;     ///< about targets that are not met; may be empty
};

/// Messages about a frame that was drawn in spite of them.
struct FrameMessages
{
  std::vector<std::string> errors;
  std::vector<std::string> warnings;
};

/// Measures the times at which frames begin.
class FrameClock
{
public:
  using SteadyClock = std::chrono::steady_clock;

  static double SecondsSince(SteadyClock::time_point start)
  {
    return std::chrono::duration<double>(SteadyClock::now() - start).count();
  }

  /// Starts a frame. `goesOn`: it follows the previous one immediately; otherwise there may have
  /// been a pause, which counts as a short one for the easing of changes.
  void Begin(bool goesOn)
  {
    constexpr double longestPause = 0.2; // [s]
    const SteadyClock::time_point now = SteadyClock::now();
    const double since = std::chrono::duration<double>(now - this->Start).count();
    this->Last = goesOn ? since : std::min(since, longestPause);
    this->Start = now;
  }

  /// Returns the time since the start of this frame [s].
  double Seconds() const { return SecondsSince(this->Start); }

  /// Returns the time from the start of the previous frame to that of this one [s].
  double SecondsSinceLast() const { return this->Last; }

private:
  SteadyClock::time_point Start;
  double Last = 0;
};
}

#endif
