// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_Interruption_h
#define limpid_backend_Interruption_h

#include <chrono>
#include <functional>

namespace limpid
{
/// Thrown by a computation that is interrupted. It is not an error: the caller asked for it.
struct Interrupted
{
};

/**
 * While alive, parallel loops of the thread that created it regularly ask whether to continue, and
 * throw Interrupted if not. The current loop is completed; incomplete results are discarded. If
 * objects are nested, the innermost one is asked.
 */
class Interruptible
{
public:
  /// `goOn` is called by this thread, at most once per `seconds`; it may do anything.
  explicit Interruptible(std::function<bool()> goOn, double seconds = 0.03);

  /// `goOn` gets the share of the last loop that has been done, see Check(share); 0 before that.
  explicit Interruptible(std::function<bool(double share)> goOn, double seconds = 0.03);

  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

  /// Asks if it is time, and may throw Interrupted. For loops with long bodies; costs nothing if
  /// no Interruptible is alive.
  static void Check()
  {
    if (Innermost)
    {
      Innermost->Ask();
    }
  }

  /// Check, from a loop of which this share has been done, in [0, 1].
  static void Check(double share)
  {
    if (Innermost)
    {
      Innermost->Done = share;
      Innermost->Ask();
    }
  }

private:
  using Clock = std::chrono::steady_clock;

  class Pause;

  void Ask();

  static thread_local Interruptible* Innermost;

  std::function<bool(double)> GoOn;
  Clock::duration Interval;
  Clock::time_point Next; ///< time of the next question
  bool Stopped = false;
  double Done = 0;
  Interruptible* Outer;
};
}

#endif
