// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_SumOnDevice_h
#define limpid_backend_SumOnDevice_h

#include "backend/CompiledDevice.h"
#include "backend/Extent.h"
#include "backend/Simd.h"
#include "math/Vec.h"

#include <memory>

namespace limpid
{
/// One of several sums: value(index) over [0, count) goes to `result` on the device; null: unused.
template <class Value>
struct Summand
{
  Value value;
  Index count;
  double* result;
};

namespace detail
{
/// A list of summands of different types, by number.
template <class... Values>
struct Summands
{
  LIMPID_HD double OfLane(int, Index, Index) const { return 0; }
  LIMPID_HD double* ResultOf(int) const { return nullptr; }
};

template <class First, class... Rest>
struct Summands<First, Rest...>
{
  Summand<First> first;
  Summands<Rest...> rest;

  /// Sum of every `lanes`-th value, starting at number `lane`.
  LIMPID_HD double OfLane(int number, Index lane, Index lanes) const
  {
    if (number > 0)
    {
      return this->rest.OfLane(number - 1, lane, lanes);
    }
    double sum = 0;
    for (Index index = lane; index < this->first.count; index += lanes)
    {
      sum += this->first.value(index);
    }
    return sum;
  }

  LIMPID_HD double* ResultOf(int number) const
  {
    return number > 0 ? this->rest.ResultOf(number - 1) : this->first.result;
  }
};

inline Summands<> Listed()
{
  return {};
}

template <class First, class... Rest>
Summands<First, Rest...> Listed(const Summand<First>& first, const Summand<Rest>&... rest)
{
  return { first, Listed(rest...) };
}

/// Adds values in three phases: many lanes add up values, fewer lanes add up these sums, and one
/// lane adds the rest. The order is the same on every device.
template <class... Values>
struct SumPhases
{
  static constexpr int phases = 3;
  static constexpr int count = sizeof...(Values);
  static constexpr int wide = 65536;
  static constexpr int narrow = 256;

  Summands<Values...> summands;
  double* partial; ///< count * (wide + narrow)

  LIMPID_HD LIMPID_INLINE Extent ExtentOf(int phase) const
  {
    return { phase == 0 ? wide : phase == 1 ? narrow : 1, count };
  }

  LIMPID_HD void operator()(int phase, int lane, int number) const
  {
    double* result = this->summands.ResultOf(number);
    if (!result)
    {
      return;
    }
    double* ofWide = this->partial + number * wide;
    double* ofNarrow = this->partial + count * wide + number * narrow;
    if (phase == 0)
    {
      ofWide[lane] = this->summands.OfLane(number, lane, wide);
    }
    else if (phase == 1)
    {
      ofNarrow[lane] = SumOf(ofWide, lane, narrow, wide);
    }
    else
    {
      *result = SumOf(ofNarrow, 0, 1, narrow);
    }
  }

private:
  LIMPID_HD static double SumOf(const double* values, int first, int step, int end)
  {
    double sum = 0;
    for (int i = first; i < end; i += step)
    {
      sum += values[i];
    }
    return sum;
  }
};
}

/// Sums on a device, in double precision and in a fixed order.
template <class AnyDevice>
class SumOnDevice
{
public:
  SumOnDevice() = default;
  explicit SumOnDevice(std::shared_ptr<AnyDevice> device)
    : Device(std::move(device))
  {
  }

  /// Computes all sums in one launch. Asynchronous.
  template <class... Values>
  void operator()(const char* label, const Summand<Values>&... summands)
  {
    using Phases = detail::SumPhases<Values...>;
    double* partial = this->Partial.RoomFor(
      this->Device, std::size_t(Phases::count) * (Phases::wide + Phases::narrow), "partial sums");
    this->Device->ForPhases(label, Phases::phases, Phases{ detail::Listed(summands...), partial });
  }

private:
  std::shared_ptr<AnyDevice> Device;
  DeviceArray<AnyDevice, double> Partial;
};
}

#endif
