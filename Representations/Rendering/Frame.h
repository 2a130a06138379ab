// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A frame of a volume in a view: what it is to be like, how much time it has, what it showed.

#ifndef limpid_Frame_h
#define limpid_Frame_h

#include "SceneLight.h"

#include "backend/Communicator.h"
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
/// What a frame is to be like.
struct FrameSettings
{
  bool still = true;    ///< off: the frame is one of a movement, and its time is limited
  bool optimize = true; ///< off: the extinction of the transfer functions
  bool measure = true;  ///< off: no score
  bool once = false;    ///< for the camera of the first still frame only
  bool paused = false;  ///< leave the extinction as it is
  Settings solver;
  ViewSet views;     ///< for which cameras
  ChosenLight light; ///< in data coordinates
  Lighting lighting; ///< but for the light itself and whether it is on
  bool lit = true;
  double sampleDistance = 1;
  bool jitter = false;
  bool showMissed = false; ///< paint over the picture what it misses of what is important
  std::array<float, 3> missedColor{ { 1, 0, 1 } };
  double frameTime = 0.1; ///< of a moving frame [s]
  double easeTime = 0.3;  ///< time constant of changes while moving [s]
  bool stepwise = false;  ///< still frames take one step of the optimisation only

  /// The processes that draw the frame together; null: there is one.
  const Communicator* ranks = nullptr;

  /// Whether any of these says so.
  bool AnyRank(bool here) const { return limpid::AnyRank(this->ranks, here); }

  /// The largest of their numbers, which are not below zero: they decide alike.
  double Largest(double here) const { return LargestOfRanks(this->ranks, here); }

  /// How pictures are made of samples; not front to back only where there is importance.
  Compositing Composing() const
  {
    return this->optimize ? InfoOf(this->solver.method).compositing : Compositing::FrontToBack;
  }

  bool CastsShadows() const { return !this->optimize || InfoOf(this->solver.method).castsShadows; }

  /// Whether pictures show another extinction than that of the transfer functions.
  bool ShowsExtinction() const
  {
    return this->optimize && this->Composing() == Compositing::FrontToBack;
  }
};

/// What a frame showed.
struct FrameResult
{
  bool measured = false; ///< whether scores are those of this frame; else they are 0
  Score score;
  Score baseScore;
  Ceiling ceiling; ///< 0 where it is not known: while the view moves, and before it converged
  bool converged = true;
  bool settled = true; ///< whether the optimisation did not end at a limit
  int iterations = 0;
  std::string light;
  std::string backend;
};

/// What went wrong in a frame that was drawn all the same.
struct FrameMessages
{
  std::vector<std::string> errors;
  std::vector<std::string> warnings;
};

/// When frames began.
class FrameClock
{
public:
  using SteadyClock = std::chrono::steady_clock;

  static double SecondsSince(SteadyClock::time_point start)
  {
    return std::chrono::duration<double>(SteadyClock::now() - start).count();
  }

  /// A frame begins. `goesOn`: it follows the last one at once; else there may have been a pause,
  /// after which changes go on easing as if it had been short.
  void Begin(bool goesOn)
  {
    constexpr double longestPause = 0.2; // [s]
    const SteadyClock::time_point now = SteadyClock::now();
    const double since = std::chrono::duration<double>(now - this->Start).count();
    this->Last = goesOn ? since : std::min(since, longestPause);
    this->Start = now;
  }

  /// Since the frame began [s].
  double Seconds() const { return SecondsSince(this->Start); }

  /// From the beginning of the last frame to that of this one [s].
  double SecondsSinceLast() const { return this->Last; }

private:
  SteadyClock::time_point Start;
  double Last = 0;
};
}

#endif
