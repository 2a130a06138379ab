// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Iterate_h
#define limpid_optimize_Iterate_h

#include "backend/LargePages.h"
#include "optimize/FoundExtinction.h"
#include "optimize/ProblemFields.h"

#include <memory>
#include <utility>
#include <vector>

namespace limpid
{
/// An extinction at all nodes: either owned, or the base extinction, which must not be
/// overwritten.
template <class AnyDevice>
struct Iterate
{
  DeviceArray<AnyDevice, float> own;
  const float* values = nullptr;
};

/// Makes an iterate writable. Returns whether it is new; it is 0 then.
template <class AnyDevice>
bool AllocateIterate(
  const std::shared_ptr<AnyDevice>& device, std::size_t count, Iterate<AnyDevice>& next)
{
  const bool isNew = next.own.Empty();
  if (isNew)
  {
    next.own = DeviceArray<AnyDevice, float>::Zeros(device, count, "an iterate");
    next.values = next.own.Data();
  }
  return isNew;
}

/// A field of a device on the host, read on request. Its memory is kept for the next time.
class FieldOnHost
{
public:
  /// The field has changed.
  void Outdate() { this->IsCurrent = false; }

  /// Returns `count` values of a field, which are read if they have changed.
  template <class AnyDevice>
  const std::vector<float>& Of(AnyDevice& device, const float* field, Index count)
  {
    if (!this->IsCurrent)
    {
      if (this->Values.empty())
      {
        this->Values = RoomFor(count);
      }
      this->Values.resize(static_cast<std::size_t>(count));
      device.Download(this->Values.data(), field, this->Values.size() * sizeof(float));
      this->IsCurrent = true;
    }
    return this->Values;
  }

  /// Moves the values out.
  std::vector<float> Take()
  {
    this->IsCurrent = false;
    return std::exchange(this->Values, {});
  }

private:
  std::vector<float> Values;
  bool IsCurrent = false;
};

/// Downloads a field from a device; waits for it.
template <class AnyDevice>
std::vector<float> OnHost(AnyDevice& device, const float* field, Index count)
{
  FieldOnHost read;
  read.Of(device, field, count);
  return read.Take();
}

/// An iterate found on a device; empty if it is the base extinction.
template <class AnyDevice>
class ResultOn : public DeviceResult
{
public:
  ResultOn(std::shared_ptr<AnyDevice> device, std::shared_ptr<ProblemFields<AnyDevice>> fields,
    DeviceArray<AnyDevice, float>&& found)
    : Device(std::move(device))
    , Given(std::move(fields))
    , Found(std::move(found))
  {
  }

  ExtinctionOnDevice Fields() const override
  {
    const float* base = this->Given->base.Data();
    return { base, this->Found.Empty() ? base : this->Found.Data() };
  }

  std::vector<float> Download() const override
  {
    return OnHost(
      *this->Device, this->Fields().extinction, static_cast<Index>(this->Given->base.Size()));
  }

private:
  std::shared_ptr<AnyDevice> Device;
  std::shared_ptr<ProblemFields<AnyDevice>> Given;
  DeviceArray<AnyDevice, float> Found;
};

/// Returns where an iterate of a minimiser is on a device; null pointers if that reads the host's.
template <class AnyDevice>
ExtinctionOnDevice PlaceOnDevice(const ProblemFields<AnyDevice>& fields, const float* iterate)
{
  return BorrowedArray<AnyDevice, float>::isCopy ? ExtinctionOnDevice{ fields.base.Data(), iterate }
                                                 : ExtinctionOnDevice();
}

/// Moves the best iterate of a minimiser out, see Minimizer::TakeResult. `own`: its values, empty
/// if it is the base extinction.
template <class AnyDevice>
FoundExtinction TakeResultOf(Minimizer& minimizer, const std::shared_ptr<AnyDevice>& device,
  const std::shared_ptr<ProblemFields<AnyDevice>>& fields, DeviceArray<AnyDevice, float>&& own)
{
  if constexpr (BorrowedArray<AnyDevice, float>::isCopy)
  {
    return FoundExtinction(std::make_unique<ResultOn<AnyDevice>>(device, fields, std::move(own)));
  }
  else
  {
    return minimizer.TakeBest();
  }
}
}

#endif
