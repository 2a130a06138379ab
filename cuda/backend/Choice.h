// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_Choice_h
#define limpid_backend_Choice_h

#include "math/Vec.h"

#include <cstddef>
#include <string>

namespace limpid
{
/// What the user wants to compute with.
enum class BackendKind
{
  Auto, ///< the fastest that works
  Cpu,
  Cuda ///< this or an error
};

/// The GPU of this process, or why there is none.
struct CudaState
{
  bool usable = false;
  int device = 0;     ///< as CUDA counts them
  std::string name;   ///< of the GPU
  std::string reason; ///< why it is not usable: "there is no NVIDIA driver"
};

/// Looks once. With several devices, processes on a machine take turns by their local rank, as the
/// launchers of MPI tell it.
const CudaState& FindCuda();

/// Bytes that are free on the GPU; 0 if there is none.
std::size_t FreeCudaBytes();

/// What is needed of a GPU.
struct GpuNeed
{
  Index nodes = 0; ///< of the largest grid
  std::size_t bytes = 0;
};

/// What a wish comes to.
struct BackendChoice
{
  bool cuda = false;
  std::string name; ///< one line for the user: what it is and, for Auto, why
};

/// One line for the user: the processor, and why it is not CUDA.
std::string CpuWithoutCuda(const std::string& reason);

/// Throws limpid::Error if CUDA was asked for and cannot be had, or not for such a need.
BackendChoice ChooseBackend(BackendKind wish, const GpuNeed& need);
}

#endif
