// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_DeviceArray_h
#define limpid_backend_DeviceArray_h

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace limpid
{
/// An array in the memory of a device, which it keeps alive.
template <class AnyDevice, class Value>
class DeviceArray
{
  static_assert(std::is_trivially_copyable<Value>::value, "is moved as bytes");

public:
  DeviceArray() = default;

  /// Allocates `count` uninitialised values. `what`: for the message if a GPU is out of memory.
  DeviceArray(std::shared_ptr<AnyDevice> device, std::size_t count, const char* what)
    : Device(std::move(device))
    , Memory(static_cast<Value*>(this->Device->Allocate(count * sizeof(Value), what)))
    , Count(count)
  {
  }

  DeviceArray(
    std::shared_ptr<AnyDevice> device, const Value* values, std::size_t count, const char* what)
    : DeviceArray(std::move(device), count, what)
  {
    this->Upload(values);
  }

  DeviceArray(std::shared_ptr<AnyDevice> device, const std::vector<Value>& values, const char* what)
    : DeviceArray(std::move(device), values.data(), values.size(), what)
  {
  }

  /// Allocates `count` zeros.
  static DeviceArray Zeros(std::shared_ptr<AnyDevice> device, std::size_t count, const char* what)
  {
    DeviceArray array;
    array.Memory = static_cast<Value*>(device->AllocateZeros(count * sizeof(Value), what));
    array.Device = std::move(device);
    array.Count = count;
    return array;
  }

  ~DeviceArray() { this->Release(); }

  DeviceArray(DeviceArray&& other) noexcept { this->Swap(other); }

  DeviceArray& operator=(DeviceArray&& other) noexcept
  {
    DeviceArray moved(std::move(other));
    this->Swap(moved);
    return *this;
  }

  Value* Data() { return this->Memory; }
  const Value* Data() const { return this->Memory; }
  std::size_t Size() const { return this->Count; }
  bool Empty() const { return this->Count == 0; }

  void Upload(const Value* values)
  {
    this->Device->Upload(this->Memory, values, this->Count * sizeof(Value));
  }

  void Download(Value* values) const
  {
    this->Device->Download(values, this->Memory, this->Count * sizeof(Value));
  }

  /// Copies from an array of the same size.
  void CopyFrom(const DeviceArray& other)
  {
    this->Device->Copy(this->Memory, other.Memory, this->Count * sizeof(Value));
  }

  void SetZero() { this->Device->SetZero(this->Memory, this->Count * sizeof(Value)); }

  /// Ensures space for at least `count` values. The content is lost if memory is reallocated.
  Value* RoomFor(const std::shared_ptr<AnyDevice>& device, std::size_t count, const char* what)
  {
    if (this->Count < count)
    {
      *this = DeviceArray(); // freed first, so that not both are allocated at once
      *this = DeviceArray(device, count, what);
    }
    return this->Memory;
  }

private:
  void Swap(DeviceArray& other) noexcept
  {
    std::swap(this->Device, other.Device);
    std::swap(this->Memory, other.Memory);
    std::swap(this->Count, other.Count);
  }

  void Release() noexcept
  {
    if (this->Device)
    {
      this->Device->Free(this->Memory, this->Count * sizeof(Value));
    }
  }

  std::shared_ptr<AnyDevice> Device;
  Value* Memory = nullptr;
  std::size_t Count = 0;
};

/// Values that a caller owns and keeps alive, for kernels to read. A device that reads host memory
/// reads them in place; other devices get a copy.
template <class AnyDevice, class Value>
class BorrowedArray
{
public:
  /// Whether the values are copied.
  static constexpr bool isCopy = !AnyDevice::readsHostMemory;

  BorrowedArray() = default;

  BorrowedArray(const std::shared_ptr<AnyDevice>& device, const Value* values, std::size_t count,
    const char* what)
  {
    this->Borrow(device, values, count, what);
  }

  /// Replaces the values. A copy reuses its memory if that is large enough.
  void Borrow(const std::shared_ptr<AnyDevice>& device, const Value* values, std::size_t count,
    const char* what)
  {
    if constexpr (isCopy)
    {
      device->Upload(this->Copy.RoomFor(device, count, what), values, count * sizeof(Value));
    }
    else
    {
      this->InPlace = values;
    }
    this->Count = count;
  }

  /// Borrow for values that the caller gives away.
  void Take(const std::shared_ptr<AnyDevice>& device, std::vector<Value>&& values, const char* what)
  {
    this->Borrow(device, values.data(), values.size(), what);
    if constexpr (!isCopy)
    {
      this->Taken = std::move(values);
    }
  }

  const Value* Data() const { return isCopy ? this->Copy.Data() : this->InPlace; }
  std::size_t Size() const { return this->Count; }
  bool Empty() const { return this->Count == 0; }

private:
  const Value* InPlace = nullptr;
  std::vector<Value> Taken; ///< keeps values in place alive
  DeviceArray<AnyDevice, Value> Copy;
  std::size_t Count = 0;
};

/// An array that a caller owns and keeps alive, for kernels to write. A device that reads host
/// memory writes in place; other devices write a copy, which must be downloaded.
template <class AnyDevice, class Value>
class ResultArray
{
public:
  /// `what`: for the message if a GPU is out of memory.
  ResultArray(std::shared_ptr<AnyDevice> device, Value* result, std::size_t count, const char* what)
    : Result(result)
  {
    if constexpr (BorrowedArray<AnyDevice, Value>::isCopy)
    {
      this->Copy = { std::move(device), count, what };
    }
  }

  Value* Data() { return this->Copy.Empty() ? this->Result : this->Copy.Data(); }

  /// Brings the caller's values to a copy, for kernels that do not write all of them.
  void Upload()
  {
    if (!this->Copy.Empty())
    {
      this->Copy.Upload(this->Result);
    }
  }

  /// Brings the values of a copy to the caller; waits for the device.
  void Download() const
  {
    if (!this->Copy.Empty())
    {
      this->Copy.Download(this->Result);
    }
  }

private:
  Value* Result;
  DeviceArray<AnyDevice, Value> Copy; ///< empty: in place
};
}

#endif
