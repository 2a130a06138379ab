// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Values made of the bytes of a fuzzer: mostly ordinary, now and then as odd as can be.

#ifndef limpid_testing_Invented_h
#define limpid_testing_Invented_h

#include <fuzzer/FuzzedDataProvider.h>

#include <cstdio>
#include <cstdlib>
#include <limits>

namespace limpid
{
class Invented
{
public:
  Invented(const std::uint8_t* bytes, std::size_t count)
    : Bytes(bytes, count)
  {
  }

  bool Chance() { return this->Bytes.ConsumeBool(); }

  int Integer(int low, int high) { return this->Bytes.ConsumeIntegralInRange(low, high); }

  /// In [low, high] but for one of 16.
  double Number(double low, double high)
  {
    constexpr double odd[] = { 0.0, -1.0, 1e-300, 1e300, 1e-38, 1e38, 1e-18, 1e-9, 1e9, 1e18,
      std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN() };
    if (this->Integer(0, 15) == 0)
    {
      return this->Bytes.PickValueInArray(odd);
    }
    return low + (high - low) * this->Integer(0, 65535) / 65535.0;
  }

private:
  FuzzedDataProvider Bytes;
};

/// Ends the program where something does not hold.
inline void Demand(bool condition, const char* what)
{
  if (!condition)
  {
    std::fprintf(stderr, "This does not hold: %s\n", what);
    std::abort();
  }
}
}

#endif
