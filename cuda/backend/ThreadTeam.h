// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_ThreadTeam_h
#define limpid_backend_ThreadTeam_h

#include "backend/Backend.h"

#include <memory>

namespace limpid
{
/**
 * While alive, the parallel loops of the thread that made it are shared with the same threads,
 * which stay awake from one loop to the next.
 *
 * A sweep is a thousand loops of some 50 microseconds each, one after the other; a thread that
 * falls asleep after each comes several microseconds late to the next. Threads that find nothing to
 * do for long let others have the processor, but do not sleep: a team is for as long as there is
 * work, not for the life of an object.
 *
 * No loop needs more than its own thread: those that are busy elsewhere are not waited for. A loop
 * inside a loop of a team is not shared, and a team inside another, or inside its loops, is none.
 */
class ThreadTeam
{
public:
  ThreadTeam();
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  /// Runs a loop of the calling thread, or says that it has no team. Throws what a body throws.
  static bool Run(Index count, Index grain, detail::RangeFunction function, const void* body);

private:
  class Members;
  std::unique_ptr<Members> Here;
};
}

#endif
