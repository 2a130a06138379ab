// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_test_SimulatedDevice_h
#define limpid_test_SimulatedDevice_h

#include "backend/HostDevice.h"

#include <atomic>
#include <cstddef>
#include <memory>

namespace limpid
{
/// The processor simulating a GPU. It runs the code for general devices even where
/// HostDevice has its own version, and can be told to fail.
class SimulatedDevice : public HostDevice
{
public:
  using HostDevice::HostDevice;
  static constexpr bool readsHostMemory = false;

  static std::shared_ptr<SimulatedDevice> Shared();

  /// Makes allocation, copy or launch number `operation` from now on throw DeviceError, and with
  /// `forGood` all later ones. Negative: none fails.
  void FailAt(Index operation, bool forGood)
  {
    this->UntilFailure = operation;
    this->FailsForGood = forGood;
  }

  /// Whether an operation has failed since then.
  bool HasFailed() const { return this->UntilFailure == Failed; }

  void* Allocate(std::size_t bytes, const char* what)
  {
    this->MayFail(what);
    return HostDevice::Allocate(bytes, what);
  }

  void* AllocateZeros(std::size_t bytes, const char* what)
  {
    this->MayFail(what);
    return HostDevice::AllocateZeros(bytes, what);
  }

  void Upload(void* to, const void* from, std::size_t bytes)
  {
    this->MayFail("upload");
    HostDevice::Upload(to, from, bytes);
  }

  void Download(void* to, const void* from, std::size_t bytes)
  {
    this->MayFail("download");
    HostDevice::Download(to, from, bytes);
  }

  void Copy(void* to, const void* from, std::size_t bytes)
  {
    this->MayFail("copy");
    HostDevice::Copy(to, from, bytes);
  }

  void SetZero(void* memory, std::size_t bytes)
  {
    this->MayFail("set to zero");
    HostDevice::SetZero(memory, bytes);
  }

  template <class Body>
  void ForEach(const char* label, const Extent& extent, const Body& body)
  {
    this->MayFail(label);
    HostDevice::ForEach(label, extent, body);
  }

  template <class Body>
  void ForIndices(const char* label, Index count, const Body& body)
  {
    this->MayFail(label);
    HostDevice::ForIndices(label, count, body);
  }

  template <class Body>
  void ForNodes(const char* label, const Int3& nodes, const Body& body)
  {
    this->MayFail(label);
    HostDevice::ForNodes(label, nodes, body);
  }

  template <class Body>
  void ForPhases(const char* label, int phases, const Body& body)
  {
    this->MayFail(label);
    HostDevice::ForPhases(label, phases, body);
  }

  template <class Body>
  void ForTiles(const char* label, const Body& body)
  {
    this->MayFail(label);
    HostDevice::ForTiles(label, body);
  }

private:
  static constexpr Index Never = -1;
  static constexpr Index Failed = -2;

  /// Throws if this operation should fail.
  void MayFail(const char* what);

  std::atomic<Index> UntilFailure{ Never };
  std::atomic<bool> FailsForGood{ false };
};

/// The device of limpid_simulated_device, see backend/CompiledDevice.h.
#ifdef LIMPID_DEVICE_HEADER
using CompiledDevice = SimulatedDevice;
#endif
}

#endif
