// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/Interruption.h"

#include <utility>

namespace limpid
{
thread_local Interruptible* Interruptible::Innermost = nullptr;

Interruptible::Interruptible(std::function<bool()> goOn, double seconds)
  : Interruptible([ask = std::move(goOn)](double) { return ask(); }, seconds)
{
}

Interruptible::Interruptible(std::function<bool(double)> goOn, double seconds)
  : GoOn(std::move(goOn))
  , Interval(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds)))
  , Outer(std::exchange(Innermost, this))
{
}

Interruptible::~Interruptible()
{
  Innermost = this->Outer;
}

/// Suspends interruption while the callback runs: the callback itself cannot be interrupted.
class Interruptible::Pause
{
public:
  Pause() { Innermost = nullptr; }
  ~Pause() { Innermost = this->Paused; }
  Pause(const Pause&) = delete;
  Pause& operator=(const Pause&) = delete;

private:
  Interruptible* const Paused = Innermost;
};

void Interruptible::Ask()
{
  if (!this->Stopped && Clock::now() >= this->Next)
  {
    const Pause pause;
    this->Stopped = !this->GoOn(this->Done);
    this->Next = Clock::now() + this->Interval;
  }
  if (this->Stopped)
  {
    throw Interrupted();
  }
}
}
