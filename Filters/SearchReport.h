// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_SearchReport_h
#define limpid_SearchReport_h

#include "backend/CallingThread.h"

#include <atomic>
#include <functional>
#include <utility>

namespace limpid
{
/**
 * Reports the progress of the threads of a search to its user, who may stop it.
 *
 * Observers of VTK's progress may do anything, so only the thread that creates this object calls
 * them. The other threads learn from it whether to continue.
 */
class SearchReport
{
public:
  /// `tell`: takes the share of the work that is done and returns whether to continue.
  explicit SearchReport(std::function<bool(double)> tell)
    : Tell(std::move(tell))
  {
  }

  /// Returns a progress function for the part of the work from `begin` to `end`, in [0, 1].
  std::function<bool(double)> Part(double begin, double end)
  {
    return [this, begin, end](double share)
    {
      if (!this->Stopped && this->Home.IsThis())
      {
        this->Stopped = !this->Tell(begin + (end - begin) * share);
      }
      return !this->Stopped;
    };
  }

  bool IsStopped() const { return this->Stopped; }

private:
  std::function<bool(double)> Tell;
  CallingThread Home;
  std::atomic<bool> Stopped{ false };
};
}

#endif
