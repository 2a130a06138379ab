// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// For the CUDA compiler only.

#ifndef limpid_backend_CudaDevice_h
#define limpid_backend_CudaDevice_h

#include "backend/Extent.h"
#include "backend/LaunchEvents.h"
#include "backend/MemoryCount.h"
#include "backend/StagedCopies.h"
#include "math/Vec.h"

#include <cooperative_groups.h>
#include <cuda_runtime.h>

#include <cstddef>
#include <limits>
#include <memory>
#include <string>

namespace limpid
{
namespace detail
{
/// Throws limpid::Error if a call of the CUDA runtime has failed.
void RequireCuda(cudaError_t status, const char* call);

// Bodies stay in constant memory (__grid_constant__). Otherwise taking the address of one would
// copy it to each thread's local memory.

/// Shape of a block of threads for columns and rows.
constexpr int blockColumns = 32;
constexpr int blockRows = 4;
constexpr int blockThreads = blockColumns * blockRows;

/// Threads per multiprocessor in launches whose blocks synchronise: enough to hide memory latency,
/// and few enough for 80 registers per thread.
constexpr int residentThreads = 768;

template <class Body>
__global__ void VisitEach(const Extent extent, const __grid_constant__ Body body)
{
  const int column = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  if (column >= extent.columns)
  {
    return;
  }
  const int step = static_cast<int>(gridDim.y * blockDim.y);
  for (int row = static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y); row < extent.rows;
       row += step)
  {
    body(column, row);
  }
}

template <class Body>
__global__ void VisitIndices(const Index count, const __grid_constant__ Body body)
{
  const Index step = Index(gridDim.x) * blockDim.x;
  for (Index index = Index(blockIdx.x) * blockDim.x + threadIdx.x; index < count; index += step)
  {
    body(index);
  }
}

template <class Body>
__global__ void VisitNodes(
  const int columns, const int rows, const Index count, const __grid_constant__ Body body)
{
  const Index step = Index(gridDim.x) * blockDim.x;
  for (Index node = Index(blockIdx.x) * blockDim.x + threadIdx.x; node < count; node += step)
  {
    const Index row = node / columns;
    body(node, static_cast<int>(node % columns), static_cast<int>(row % rows),
      static_cast<int>(row / rows));
  }
}

template <class Body>
__global__ void __launch_bounds__(blockThreads, residentThreads / blockThreads)
  VisitPhases(const int phases, const __grid_constant__ Body body)
{
  const cooperative_groups::grid_group grid = cooperative_groups::this_grid();
  for (int phase = 0; phase < phases; ++phase)
  {
    if (phase > 0)
    {
      grid.sync();
    }
    const Extent extent = body.ExtentOf(phase);
    const int across =
      (extent.columns + static_cast<int>(blockDim.x) - 1) / static_cast<int>(blockDim.x);
    const int down =
      (extent.rows + static_cast<int>(blockDim.y) - 1) / static_cast<int>(blockDim.y);
    for (int tile = static_cast<int>(blockIdx.x); tile < across * down;
         tile += static_cast<int>(gridDim.x))
    {
      const int column =
        tile % across * static_cast<int>(blockDim.x) + static_cast<int>(threadIdx.x);
      const int row = tile / across * static_cast<int>(blockDim.y) + static_cast<int>(threadIdx.y);
      if (column < extent.columns && row < extent.rows)
      {
        body(phase, column, row);
      }
    }
  }
}

template <class Body>
__global__ void __launch_bounds__(Body::tileThreads, Body::residentThreads / Body::tileThreads)
  VisitTiles(const __grid_constant__ Body body)
{
  const cooperative_groups::grid_group grid = cooperative_groups::this_grid();
  const int phases = *body.lists.phaseCount; // the same for all threads
  if (phases == 0)
  {
    return;
  }
  auto next = body.lists.phases[0];
  for (int number = 0; number < phases; ++number)
  {
    const auto phase = next;
    if (number > 0)
    {
      grid.sync();
    }
    if (number + 1 < phases)
    {
      next = body.lists.phases[number + 1]; // prefetched before it is needed
    }
    for (int index = static_cast<int>(blockIdx.x); index < phase.count;
         index += static_cast<int>(gridDim.x))
    {
      const auto tile = body.TileOf(phase, body.lists.numbers[phase.first + index]);
      for (int step = 0; step < tile.steps; ++step)
      {
        if (step > 0)
        {
          __syncthreads();
        }
        const Extent extent = tile.ExtentOf(step);
        for (int item = static_cast<int>(threadIdx.x); item < extent.columns * extent.rows;
             item += static_cast<int>(blockDim.x))
        {
          body.Visit(tile, step, item % extent.columns, item / extent.columns);
        }
      }
    }
  }
}
}

#define LIMPID_CUDA(call) ::limpid::detail::RequireCuda((call), #call)

/// A GPU with one stream. All operations are executed in order. Download and Wait block, and Free
/// where nothing else is allocated.
class CudaDevice
{
public:
  /// Whether kernels can read host memory, see BorrowedArray.
  static constexpr bool readsHostMemory = false;

  /// GPU threads need not be kept awake, see HostDevice.
  struct Team
  {
  };

  /// Returns the GPU of this process (FindCuda), shared by all current users.
  static std::shared_ptr<CudaDevice> Shared();

  /// Throws limpid::Error if there is no such device. `number`: its CUDA index.
  explicit CudaDevice(int number);
  ~CudaDevice();
  CudaDevice(const CudaDevice&) = delete;
  CudaDevice& operator=(const CudaDevice&) = delete;

  std::string Name() const { return this->Title; }

  /// Throws limpid::Error if there is not enough memory. `what`: for the message. This and all
  /// following members are thread-safe.
  void* Allocate(std::size_t bytes, const char* what);

  /// Allocates memory that is filled with 0.
  void* AllocateZeros(std::size_t bytes, const char* what);

  /// Memory that is freed is kept for later allocations, until nothing is allocated any more.
  void Free(void* memory, std::size_t bytes) noexcept;

  /// Has read all of `from` when it returns.
  void Upload(void* to, const void* from, std::size_t bytes);
  void Download(void* to, const void* from, std::size_t bytes);
  void Copy(void* to, const void* from, std::size_t bytes);
  void SetZero(void* memory, std::size_t bytes);

  /// Waits until all operations are finished.
  void Wait();

  /// Starts adding up the GPU times of all operations in `times`; null: stops, after which the
  /// times are complete. For one thread.
  void Time(LaunchTimes* times);

  /// Bytes that are currently allocated.
  std::size_t Bytes() const { return this->Memory.Bytes(); }

  /// Largest number of bytes allocated at any time.
  std::size_t PeakBytes() const { return this->Memory.Peak(); }

  /// Calls body(column, row) for every element of an extent, in any order. `label`: for profilers.
  template <class Body>
  void ForEach(const char* label, const Extent& extent, const Body& body)
  {
    if (extent.columns <= 0 || extent.rows <= 0)
    {
      return;
    }
    this->Use();
    const dim3 block = BlockOf();
    constexpr unsigned mostRows = 65535; // limit of the number of blocks along y; rows beyond it
                                         // are visited in a loop
    const unsigned down = (extent.rows + block.y - 1) / block.y;
    const dim3 grid((extent.columns + block.x - 1) / block.x, down < mostRows ? down : mostRows);
    const Timed timed(*this, { label });
    detail::VisitEach<<<grid, block, 0, this->Stream>>>(extent, body);
    detail::RequireCuda(cudaGetLastError(), label);
  }

  /// Calls body(index) for every index in [0, count), in any order.
  template <class Body>
  void ForIndices(const char* label, Index count, const Body& body)
  {
    if (count <= 0)
    {
      return;
    }
    this->Use();
    const Timed timed(*this, { label });
    detail::VisitIndices<<<this->BlocksFor(count), Threads, 0, this->Stream>>>(count, body);
    detail::RequireCuda(cudaGetLastError(), label);
  }

  /// Calls body(node, i, j, k) for every node of a grid, in any order.
  template <class Body>
  void ForNodes(const char* label, const Int3& nodes, const Body& body)
  {
    const Index count = Index(nodes.x) * nodes.y * nodes.z;
    if (count <= 0)
    {
      return;
    }
    this->Use();
    const Timed timed(*this, { label });
    detail::VisitNodes<<<this->BlocksFor(count), Threads, 0, this->Stream>>>(
      nodes.x, nodes.y, count, body);
    detail::RequireCuda(cudaGetLastError(), label);
  }

  /// Runs phases in order; each is like ForEach over body.ExtentOf(phase) with body(phase, column,
  /// row). A phase sees everything written by earlier phases. Uses one cooperative launch, which
  /// synchronises all blocks between phases.
  template <class Body>
  void ForPhases(const char* label, int phases, const Body& body)
  {
    this->LaunchResident({ label, 0, phases - 1 }, &detail::VisitPhases<Body>, BlockOf(),
      std::numeric_limits<int>::max(), phases, body);
  }

  /// Runs all phases of a body in order, and the tiles of a phase in any order: those of the
  /// numbers that body.lists has for the phase (PhasesOfTiles). The steps of a tile run in order,
  /// each like ForEach over tile.ExtentOf(step) with body.Visit(tile, step, column, row). Here tile
  /// is body.TileOf(phase, number). A step sees what earlier steps of the tile and earlier phases
  /// have written. Tiles of a phase may write equal values to the same address. Uses one launch,
  /// with blocks for as many tiles as a phase may have: only the device knows how many it has.
  /// Likewise, LaunchTimes has no number of waits.
  template <class Body>
  void ForTiles(const char* label, const Body& body)
  {
    this->LaunchResident(
      { label }, &detail::VisitTiles<Body>, dim3(Body::tileThreads), body.lists.mostTiles, body);
  }

private:
  /// Returns freed memory to the system.
  void Trim() noexcept;

  /// Makes it the current device of the calling thread.
  void Use() const;

  static dim3 BlockOf() { return dim3(detail::blockColumns, detail::blockRows); }

  /// Launches as many blocks as can be resident at the same time, at most `mostBlocks`.
  template <class... Arguments>
  void LaunchResident(const Launch& launch, void (*kernel)(Arguments...), const dim3& block,
    int mostBlocks, Arguments... arguments)
  {
    this->Use();
    int blocksPerProcessor = 0;
    LIMPID_CUDA(cudaOccupancyMaxActiveBlocksPerMultiprocessor(
      &blocksPerProcessor, kernel, static_cast<int>(block.x * block.y), 0));
    const int resident = blocksPerProcessor * this->Processors;
    const dim3 grid(static_cast<unsigned>(resident < mostBlocks ? resident : mostBlocks));
    void* addresses[] = { &arguments... };
    const Timed timed(*this, launch);
    detail::RequireCuda(cudaLaunchCooperativeKernel(reinterpret_cast<const void*>(kernel), grid,
                          block, addresses, 0, this->Stream),
      launch.label);
  }

  /// Returns the number of blocks for `count` indices; threads loop if there are more indices.
  unsigned BlocksFor(Index count) const
  {
    const Index wanted = (count + Threads - 1) / Threads;
    return static_cast<unsigned>(wanted < this->MostBlocks ? wanted : this->MostBlocks);
  }

  static constexpr unsigned Threads = 256;

  /// Times everything that is launched during its lifetime, if timing is on.
  class Timed
  {
  public:
    Timed(const CudaDevice& device, const Launch& launch)
      : Events(device.Events.get())
    {
      if (this->Events)
      {
        this->Events->Begin(launch);
      }
    }

    ~Timed()
    {
      if (this->Events)
      {
        this->Events->End();
      }
    }

    Timed(const Timed&) = delete;
    Timed& operator=(const Timed&) = delete;

  private:
    LaunchEvents* Events;
  };

  std::string Title;
  cudaStream_t Stream = nullptr;
  std::unique_ptr<StagedCopies> Staged;
  std::unique_ptr<LaunchEvents> Events; ///< null if timing is off
  int Number = 0;
  int Processors = 1;
  Index MostBlocks = 1;
  MemoryCount Memory;
};
}

#endif
