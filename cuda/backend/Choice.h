// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_Choice_h
#define limpid_backend_Choice_h

#include "math/Vec.h"

#include <cstddef>
#include <string>

namespace limpid
{
/// The user's choice of backend.
enum class BackendKind
{
  Auto, ///< the fastest that works
  Cpu,
  Cuda ///< CUDA, or an error
};

/// The GPU of this process, or the reason why there is none.
struct CudaState
{
  bool usable = false;
  int device = 0;     ///< index of the CUDA device
  std::string name;   ///< name of the GPU
  std::string reason; ///< why it is not usable: "there is no NVIDIA driver"
};

/// Detects the GPU once. If there are several, the processes on a machine take them in turn by
/// their local number, as set by MPI launchers.
const CudaState& FindCuda();

/// Returns the free bytes on the GPU; 0 if there is none.
std::size_t FreeCudaBytes();

/// Requirements for a GPU.
struct GpuNeed
{
  Index nodes = 0; ///< of the largest grid
  std::size_t bytes = 0;
};

/// The backend that is used.
struct BackendChoice
{
  bool cuda = false;
  std::string name; ///< one line for the user: the backend and, for Auto, the reason
};

/// Returns one line for the user: the processor, and the reason why CUDA is not used.
std::string CpuWithoutCuda(const std::string& reason);

/// Throws limpid::Error if CUDA was requested but is not available or does not meet `need`.
BackendChoice ChooseBackend(BackendKind wish, const GpuNeed& need);
}

#endif
