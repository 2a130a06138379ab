// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// For the CUDA compiler only.

#ifndef limpid_backend_StagedCopies_h
#define limpid_backend_StagedCopies_h

#include <cuda_runtime.h>

#include <cstddef>
#include <mutex>

namespace limpid
{
/**
 * Copies between memory of the host and of a GPU through two rooms of page-locked memory: while
 * the GPU copies from one, the processor fills the other. A GPU copies page-locked memory several
 * times faster than other memory. All members are thread-safe.
 */
class StagedCopies
{
public:
  explicit StagedCopies(cudaStream_t stream)
    : Stream(stream)
  {
  }
  ~StagedCopies();
  StagedCopies(const StagedCopies&) = delete;
  StagedCopies& operator=(const StagedCopies&) = delete;

  /// Has read all of `from` when it returns; the GPU may still be copying.
  void Upload(void* to, const void* from, std::size_t bytes);

  /// Returns when `to` is complete.
  void Download(void* to, const void* from, std::size_t bytes);

private:
  static constexpr std::size_t roomBytes = std::size_t(4) << 20;

  struct Room
  {
    void* memory = nullptr;
    cudaEvent_t copied = nullptr; ///< the GPU no longer uses the room
  };

  /// Allocates the rooms on first use.
  void Prepare();

  cudaStream_t Stream;
  std::mutex Mutex;
  Room Rooms[2];
  std::size_t Next = 0; ///< number of copies so far; they use the rooms in turn
};
}

#endif
