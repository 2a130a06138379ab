// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_HostDevice_h
#define limpid_backend_HostDevice_h

#include "backend/Backend.h"
#include "backend/Extent.h"

#include <cstddef>
#include <string>

namespace limpid
{
/**
 * The processor in the role of a device: what is written for a GPU runs here, launch by launch, so
 * that tests need none. Has the interface of CudaDevice.
 */
class HostDevice
{
public:
  HostDevice() = default;
  HostDevice(const HostDevice&) = delete;
  HostDevice& operator=(const HostDevice&) = delete;

  std::string Name() const { return CpuName(); }

  /// Throws limpid::Error if there is not enough memory. `what`: for the message.
  void* Allocate(std::size_t bytes, const char* what);
  void Free(void* memory, std::size_t bytes) noexcept;

  void Upload(void* to, const void* from, std::size_t bytes);
  void Download(void* to, const void* from, std::size_t bytes);
  void Copy(void* to, const void* from, std::size_t bytes);
  void SetZero(void* memory, std::size_t bytes);

  /// Bytes that are allocated now.
  std::size_t Bytes() const { return this->Allocated; }

  /// Most bytes that were allocated at a time.
  std::size_t PeakBytes() const { return this->Peak; }

  /// body(column, row) for every element of an extent, in any order. `label`: for profilers.
  template <class Body>
  void ForEach(const char*, const Extent& extent, const Body& body)
  {
    constexpr Index grain = 4;
    ParallelFor(extent.rows, grain,
      [&](Index row)
      {
        for (int column = 0; column < extent.columns; ++column)
        {
          body(column, static_cast<int>(row));
        }
      });
  }

  /// body(index) for every index in [0, count), in any order.
  template <class Body>
  void ForIndices(const char*, Index count, const Body& body)
  {
    constexpr Index grain = 4096;
    ParallelFor(count, grain, body);
  }

  /// Phases in order, each like ForEach over body.ExtentOf(phase) of body(phase, column, row). A
  /// phase sees all that the phases before it have written.
  template <class Body>
  void ForPhases(const char* label, int phases, const Body& body)
  {
    for (int phase = 0; phase < phases; ++phase)
    {
      this->ForEach(
        label, body.ExtentOf(phase), [&](int column, int row) { body(phase, column, row); });
    }
  }

private:
  std::size_t Allocated = 0;
  std::size_t Peak = 0;
};
}

#endif
