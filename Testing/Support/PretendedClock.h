// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_test_PretendedClock_h
#define limpid_test_PretendedClock_h

namespace limpid
{
/// Previews of this thread take so many seconds per node while it lives. For programs that link
/// limpid_pretended_clock ahead of the core.
class PretendedClock
{
public:
  explicit PretendedClock(double secondsPerNode);
  ~PretendedClock();
  PretendedClock(const PretendedClock&) = delete;
  PretendedClock& operator=(const PretendedClock&) = delete;
};
}

#endif
