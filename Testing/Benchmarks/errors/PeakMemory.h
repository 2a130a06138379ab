// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_benchmarks_errors_PeakMemory_h
#define limpid_testing_benchmarks_errors_PeakMemory_h

namespace limpid::benchmark
{
/// The most memory that this process has had resident since the object was made, beyond what it
/// had then.
class PeakMemory
{
public:
  PeakMemory();
  double Bytes() const; ///< 0 where the system does not tell

private:
  double Before;
};
}

#endif
