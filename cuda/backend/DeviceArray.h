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

/**
 * Values that a caller owns and keeps alive. A device that reads host memory uses them in place;
 * other devices get a copy.
 */
template <class AnyDevice, class Value>
class BorrowedArray
{
public:
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
    if constexpr (AnyDevice::readsHostMemory)
    {
      this->InPlace = values;
    }
    else
    {
      device->Upload(this->Copy.RoomFor(device, count, what), values, count * sizeof(Value));
    }
    this->Count = count;
  }

  const Value* Data() const
  {
    return AnyDevice::readsHostMemory ? this->InPlace : this->Copy.Data();
  }
  std::size_t Size() const { return this->Count; }
  bool Empty() const { return this->Count == 0; }

private:
  const Value* InPlace = nullptr;
  DeviceArray<AnyDevice, Value> Copy;
  std::size_t Count = 0;
};
}

#endif
