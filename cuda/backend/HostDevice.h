// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_HostDevice_h
#define limpid_backend_HostDevice_h

#include "backend/Backend.h"
#include "backend/Extent.h"
#include "backend/LaunchTimes.h"
#include "backend/MemoryCount.h"
#include "backend/ThreadTeam.h"

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>

namespace limpid
{
/// The processor as a device. It has the interface of CudaDevice, so that launching code is
/// written only once.
class HostDevice
{
public:
  /// Keeps threads awake between the launches of a sweep.
  using Team = ThreadTeam;

  /// Whether kernels can read host memory, see BorrowedArray.
  static constexpr bool readsHostMemory = true;

  HostDevice() = default;

  /// Returns the processor, shared by all current users.
  static std::shared_ptr<HostDevice> Shared();

  /// For compatibility with CudaDevice; there is only one processor.
  explicit HostDevice(int) {}

  HostDevice(const HostDevice&) = delete;
  HostDevice& operator=(const HostDevice&) = delete;

  std::string Name() const { return CpuName(); }

  /// Throws std::bad_alloc if there is not enough memory, like host code without a device. This
  /// and all following members are thread-safe.
  void* Allocate(std::size_t bytes, const char* what);

  /// Allocates memory filled with 0. Large parts that stay 0 take neither memory nor time.
  void* AllocateZeros(std::size_t bytes, const char* what);
  void Free(void* memory, std::size_t bytes) noexcept;

  void Upload(void* to, const void* from, std::size_t bytes);
  void Download(void* to, const void* from, std::size_t bytes);
  void Copy(void* to, const void* from, std::size_t bytes);
  void SetZero(void* memory, std::size_t bytes);

  /// Waits until all operations are finished.
  void Wait() {}

  /// Starts adding up the times of all operations in `times`; null: stops. For one thread.
  void Time(LaunchTimes* times) { this->Times = times; }

  /// Bytes that are currently allocated.
  std::size_t Bytes() const { return this->Memory.Bytes(); }

  /// Largest number of bytes allocated at any time.
  std::size_t PeakBytes() const { return this->Memory.Peak(); }

  /// Calls body(column, row) for every element of an extent, in any order. `label`: for profilers.
  template <class Body>
  void ForEach(const char* label, const Extent& extent, const Body& body)
  {
    const Timed timed(this->Times, { label });
    Visit(extent, body);
  }

  /// Calls body(index) for every index in [0, count), in any order.
  template <class Body>
  void ForIndices(const char* label, Index count, const Body& body)
  {
    const Timed timed(this->Times, { label });
    constexpr Index grain = 4096;
    const auto range = [](const void* typeless, Index begin, Index end)
    {
      const Body own = *static_cast<const Body*>(typeless); // local copy: writes cannot alias it
      for (Index index = begin; index < end; ++index)
      {
        own(index);
      }
    };
    detail::ParallelRanges(count, grain, range, &body);
  }

  /// Calls body(node, i, j, k) for every node of a grid, in any order.
  template <class Body>
  void ForNodes(const char* label, const Int3& nodes, const Body& body)
  {
    this->ForRows(label, nodes,
      [&](Index first, int j, int k)
      {
        const Body own = body; // local copy: writes below cannot alias it
        for (int i = 0; i < nodes.x; ++i)
        {
          own(first + i, i, j, k);
        }
      });
  }

  /// Calls body(node, j, k) for the first node of every row of a grid, in any order.
  template <class Body>
  void ForRows(const char* label, const Int3& nodes, const Body& body)
  {
    const Timed timed(this->Times, { label });
    constexpr Index rowsPerTask = 16;
    ParallelFor(Index(nodes.y) * nodes.z, rowsPerTask,
      [&](Index row)
      { body(row * nodes.x, static_cast<int>(row % nodes.y), static_cast<int>(row / nodes.y)); });
  }

  /// Runs phases in order; each is like ForEach over body.ExtentOf(phase) with body(phase, column,
  /// row). A phase sees everything written by earlier phases.
  template <class Body>
  void ForPhases(const char* label, int phases, const Body& body)
  {
    const Timed timed(this->Times, { label, 0, phases - 1 });
    for (int phase = 0; phase < phases; ++phase)
    {
      Visit(body.ExtentOf(phase), [&](int column, int row) { body(phase, column, row); });
    }
  }

  /// Runs all phases of a body in order, and the tiles of a phase in any order: those of the
  /// numbers that body.lists has for the phase (PhasesOfTiles). The steps of a tile run in order,
  /// each like ForEach over tile.ExtentOf(step) with body.Visit(tile, step, column, row). Here tile
  /// is body.TileOf(phase, number). A step sees what earlier steps of the tile and earlier phases
  /// have written. Tiles of a phase may write equal values to the same address. Here they therefore
  /// run one by one, in alternating order.
  template <class Body>
  void ForTiles(const char* label, const Body& body)
  {
    const auto& lists = body.lists;
    const int phases = *lists.phaseCount;
    const Timed timed(this->Times, { label, 0, phases > 0 ? phases - 1 : 0 });
    for (int number = 0; number < phases; ++number)
    {
      const auto& phase = lists.phases[number];
      for (int index = 0; index < phase.count; ++index)
      {
        const int inAnyOrder = number % 2 == 0 ? index : phase.count - 1 - index;
        const auto tile = body.TileOf(phase, lists.numbers[phase.first + inAnyOrder]);
        for (int step = 0; step < tile.steps; ++step)
        {
          Visit(
            tile.ExtentOf(step), [&](int column, int row) { body.Visit(tile, step, column, row); });
        }
      }
    }
  }

private:
  /// Records its own lifetime.
  class Timed
  {
  public:
    Timed(LaunchTimes* times, const Launch& launch)
      : Times(times)
      , What(launch)
    {
    }

    ~Timed()
    {
      if (this->Times)
      {
        const std::chrono::duration<double> seconds = Clock::now() - this->Start;
        this->Times->Add(this->What, seconds.count());
      }
    }

    Timed(const Timed&) = delete;
    Timed& operator=(const Timed&) = delete;

  private:
    using Clock = std::chrono::steady_clock;
    LaunchTimes* Times;
    Launch What;
    Clock::time_point Start = Clock::now();
  };

  /// Counts allocated memory; throws if the allocation failed.
  void* Take(void* memory, std::size_t bytes);

  template <class Body>
  static void Visit(const Extent& extent, const Body& body)
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

  LaunchTimes* Times = nullptr; ///< null if timing is off
  MemoryCount Memory;
};
}

#endif
