// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// For the CUDA compiler only.

#ifndef limpid_backend_LaunchEvents_h
#define limpid_backend_LaunchEvents_h

#include "backend/LaunchTimes.h"

#include <cuda_runtime.h>

#include <string>
#include <vector>

namespace limpid
{
/// Events in a GPU stream, before and after every timed operation.
class LaunchEvents
{
public:
  /// `times` and `stream` must outlive it.
  LaunchEvents(LaunchTimes& times, cudaStream_t stream)
    : Times(&times)
    , Stream(stream)
  {
  }
  ~LaunchEvents();
  LaunchEvents(const LaunchEvents&) = delete;
  LaunchEvents& operator=(const LaunchEvents&) = delete;

  void Begin(const Launch& launch);
  void End();

  /// Adds up the times between the events. All work in the stream must be finished.
  void Collect();

private:
  struct Span
  {
    Launch launch{ nullptr };
    cudaEvent_t begin = nullptr;
    cudaEvent_t end = nullptr;
  };

  LaunchTimes* Times;
  cudaStream_t Stream;
  std::vector<Span> Spans;
};
}

#endif
