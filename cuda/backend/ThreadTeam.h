// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_ThreadTeam_h
#define limpid_backend_ThreadTeam_h

#include "backend/Backend.h"

#include <memory>

namespace limpid
{
/**
 * While alive, the parallel loops of the thread that created it are shared by the same threads,
 * which stay awake between loops.
 *
 * A sweep consists of about a thousand consecutive loops of some 50 microseconds each. A thread
 * that sleeps after each loop joins the next one several microseconds late. Threads without work
 * for long yield the processor but do not sleep. A team should therefore live only as long as
 * there is work.
 *
 * A loop only needs its own thread and does not wait for busy ones. A loop nested in a loop of a
 * team is not shared. A team nested in another team or its loops has no effect.
 */
class ThreadTeam
{
public:
  ThreadTeam();
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  /// Runs a loop of the calling thread; returns false if it has no team. Rethrows exceptions of a
  /// body.
  static bool Run(Index count, Index grain, detail::RangeFunction function, const void* body);

private:
  class Members;
  std::unique_ptr<Members> Here;
};
}

#endif
