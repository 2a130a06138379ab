// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_SumOnDevice_h
#define limpid_backend_SumOnDevice_h

#include "backend/CompiledDevice.h"
#include "backend/Simd.h"
#include "math/Vec.h"

#include <memory>

namespace limpid
{
namespace detail
{
/// Lane `index` adds up every `lanes`-th value of `count`.
template <class Value>
struct SumLane
{
  Value value;
  Index count;
  Index lanes;
  double* sums;

  LIMPID_HD void operator()(Index index) const
  {
    double sum = 0;
    for (Index i = index; i < this->count; i += this->lanes)
    {
      sum += this->value(i);
    }
    this->sums[index] = sum;
  }
};

/// The sums of another pass.
struct PartialSum
{
  const double* sums;
  LIMPID_HD LIMPID_INLINE double operator()(Index index) const { return this->sums[index]; }
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
    , Partial(this->Device, std::size_t(Wide + Narrow), "partial sums")
  {
  }

  /// Adds up value(index) over [0, count) into `result` on the device. Does not wait.
  template <class Value>
  void operator()(const char* label, Index count, const Value& value, double* result)
  {
    double* wide = this->Partial.Data();
    double* narrow = wide + Wide;
    this->Pass(label, detail::SumLane<Value>{ value, count, Wide, wide });
    this->Pass(label, detail::SumLane<detail::PartialSum>{ { wide }, Wide, Narrow, narrow });
    this->Pass(label, detail::SumLane<detail::PartialSum>{ { narrow }, Narrow, 1, result });
  }

private:
  static constexpr Index Wide = 65536;
  static constexpr Index Narrow = 256;

  template <class Lane>
  void Pass(const char* label, const Lane& lane)
  {
    this->Device->ForIndices(label, lane.lanes, lane);
  }

  std::shared_ptr<AnyDevice> Device;
  DeviceArray<AnyDevice, double> Partial;
};
}

#endif
