// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_Interruption_h
#define limpid_backend_Interruption_h

#include <chrono>
#include <functional>

namespace limpid
{
/// Thrown by a computation that is to go no further. Not an error: who interrupts knows why.
struct Interrupted
{
};

/**
 * While alive, parallel loops of the thread that made it ask now and then whether to go on, and
 * throw Interrupted if not: whatever the computation is busy with, it ends with the present loop.
 * Nothing is kept of what has been begun. The innermost one is asked.
 */
class Interruptible
{
public:
  /// `goOn` is called by this thread, every so many seconds at most; it may do anything.
  explicit Interruptible(std::function<bool()> goOn, double seconds = 0.03);
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

  /// Asks if it is time to, and throws Interrupted. For loops with long bodies; free where nothing
  /// can be interrupted.
  static void Check()
  {
    if (Innermost)
    {
      Innermost->Ask();
    }
  }

private:
  using Clock = std::chrono::steady_clock;

  class Pause;

  void Ask();

  static thread_local Interruptible* Innermost;

  std::function<bool()> GoOn;
  Clock::duration Interval;
  Clock::time_point Next; ///< when to ask again
  bool Stopped = false;
  Interruptible* Outer;
};
}

#endif
