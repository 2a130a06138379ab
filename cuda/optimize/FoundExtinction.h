// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_FoundExtinction_h
#define limpid_optimize_FoundExtinction_h

#include <memory>
#include <utility>
#include <vector>

namespace limpid
{
/// The fields that a picture of an extinction needs, in the memory of the device that all who use
/// it share; one value per node each [1/length].
struct ExtinctionOnDevice
{
  const float* base = nullptr;
  const float* extinction = nullptr;
};

/// An extinction that a device has found and still has.
class DeviceResult
{
public:
  virtual ~DeviceResult() = default;
  virtual ExtinctionOnDevice Fields() const = 0;

  /// The extinction. Waits.
  virtual std::vector<float> Download() const = 0;
};

/// An extinction that was found, one value per node [1/length]. It stays where it was found until
/// the host asks for it.
class FoundExtinction
{
public:
  FoundExtinction() = default;
  FoundExtinction(std::vector<float> values)
    : Values(std::move(values))
  {
  }
  explicit FoundExtinction(std::unique_ptr<DeviceResult> result)
    : There(std::move(result))
  {
  }

  /// Nulls: it is on the host alone.
  ExtinctionOnDevice OnDevice() const
  {
    return this->There ? this->There->Fields() : ExtinctionOnDevice();
  }

  /// Empty: nothing was found. A device that has it is asked once.
  const std::vector<float>& OnHost() const
  {
    if (this->There && this->Values.empty())
    {
      this->Values = this->There->Download();
    }
    return this->Values;
  }

  /// The same, given away.
  std::vector<float> Take()
  {
    this->OnHost();
    this->There.reset();
    return std::move(this->Values);
  }

private:
  std::unique_ptr<DeviceResult> There;
  mutable std::vector<float> Values;
};
}

#endif
