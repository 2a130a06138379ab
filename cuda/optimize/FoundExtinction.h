// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_FoundExtinction_h
#define limpid_optimize_FoundExtinction_h

#include <memory>
#include <utility>
#include <vector>

namespace limpid
{
/// The fields that a picture of an extinction needs, in the memory of the shared device; one value
/// per node each [1/length].
struct ExtinctionOnDevice
{
  const float* base = nullptr;
  const float* extinction = nullptr;
};

/// An extinction to read where it is, one value per node [1/length].
struct ExtinctionInPlace
{
  const float* values = nullptr;
  bool onDevice = false; ///< whether they are in the memory of the device that computes

  ExtinctionInPlace(const float* onHost)
    : values(onHost)
  {
  }
  explicit ExtinctionInPlace(const ExtinctionOnDevice& there)
    : values(there.extinction)
    , onDevice(true)
  {
  }
};

/// An extinction that was found on a device and is still there.
class DeviceResult
{
public:
  virtual ~DeviceResult() = default;
  virtual ExtinctionOnDevice Fields() const = 0;

  /// Downloads the extinction; waits for the device.
  virtual std::vector<float> Download() const = 0;
};

/// The extinction found, one value per node [1/length]. It stays on its device until the host asks
/// for it.
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

  /// Null pointers if the extinction is only on the host.
  ExtinctionOnDevice OnDevice() const
  {
    return this->There ? this->There->Fields() : ExtinctionOnDevice();
  }

  /// Where it can be read without a transfer.
  ExtinctionInPlace InPlace() const
  {
    return this->There ? ExtinctionInPlace(this->There->Fields()) : this->Values.data();
  }

  /// Empty if nothing was found. The values are downloaded on the first call only.
  const std::vector<float>& OnHost() const
  {
    if (this->There && this->Values.empty())
    {
      this->Values = this->There->Download();
    }
    return this->Values;
  }

  /// Moves the values out of this object.
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

/// What was found for a view. It may still be read as the reference of the next view when another
/// result is shown.
struct FoundExtinctions
{
  std::shared_ptr<const FoundExtinction> extinction; ///< null: nothing was found
  std::shared_ptr<const FoundExtinction> light;      ///< null: same as `extinction`

  const FoundExtinction& Of(bool forLight) const
  {
    return forLight && this->light ? *this->light : *this->extinction;
  }
};
}

#endif
