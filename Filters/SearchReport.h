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
 * Between the threads of a search and its user, who is told how far it is and may stop it.
 *
 * Observers of VTK's progress may do anything, so only the thread that makes this object talks to
 * them; the others hear from it whether to go on.
 */
class SearchReport
{
public:
  /// `tell`: takes the share of the work done and returns whether to go on.
  explicit SearchReport(std::function<bool(double)> tell)
    : Tell(std::move(tell))
  {
  }

  /// What is between `begin` and `end` of all of the work, as a progress of its own.
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
