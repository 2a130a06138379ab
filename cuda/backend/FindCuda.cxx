// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// For the CUDA compiler.

#include "backend/Choice.h"
#include "backend/CudaDevice.h"

#include <cstdlib>

namespace limpid
{
namespace
{
/// Index of this process among those on the same machine; 0 without an MPI launcher.
int LocalRank()
{
  for (const char* name : { "OMPI_COMM_WORLD_LOCAL_RANK", "MPI_LOCALRANKID",
         "MV2_COMM_WORLD_LOCAL_RANK", "SLURM_LOCALID", "PALS_LOCAL_RANKID" })
  {
    if (const char* value = std::getenv(name))
    {
      return static_cast<int>(std::strtol(value, nullptr, 10));
    }
  }
  return 0;
}

std::string WhyNone(cudaError_t status)
{
  cudaGetLastError();
  int driver = 0;
  cudaDriverGetVersion(&driver);
  if (driver == 0)
  {
    return "there is no NVIDIA driver";
  }
  return status == cudaErrorNoDevice
    ? std::string("there is no NVIDIA GPU")
    : std::string("CUDA reports \"") + cudaGetErrorString(status) + '"';
}

__global__ void DoNothing() {}

CudaState Look()
{
  CudaState state;
  int count = 0;
  const cudaError_t status = cudaGetDeviceCount(&count);
  if (status != cudaSuccess || count == 0)
  {
    state.reason = WhyNone(status);
    return state;
  }
  state.device = LocalRank() % count;
  cudaDeviceProp properties{};
  const cudaError_t described = cudaGetDeviceProperties(&properties, state.device);
  if (described != cudaSuccess)
  {
    state.reason = WhyNone(described);
    return state;
  }
  state.name = properties.name;
  cudaFuncAttributes attributes{};
  cudaSetDevice(state.device);
  const cudaError_t loaded = cudaFuncGetAttributes(&attributes, DoNothing);
  if (loaded != cudaSuccess)
  {
    cudaGetLastError();
    state.reason = "the GPU " + state.name + " is not supported by this build";
    return state;
  }
  if (!properties.cooperativeLaunch)
  {
    state.reason = "the GPU " + state.name + " does not support cooperative launches";
    return state;
  }
  if (!properties.memoryPoolsSupported)
  {
    state.reason = "the GPU " + state.name + " or its driver does not support memory pools";
    return state;
  }
  state.usable = true;
  return state;
}
}

const CudaState& FindCuda()
{
  static const CudaState state = Look();
  return state;
}

std::size_t FreeCudaBytes()
{
  std::size_t free = 0;
  std::size_t total = 0;
  if (!FindCuda().usable || cudaSetDevice(FindCuda().device) != cudaSuccess ||
    cudaMemGetInfo(&free, &total) != cudaSuccess)
  {
    cudaGetLastError();
    return 0;
  }
  // Memory reserved by this process's own pool can be reused.
  cudaMemPool_t pool{};
  std::uint64_t reserved = 0;
  std::uint64_t used = 0;
  if (cudaDeviceGetDefaultMemPool(&pool, FindCuda().device) == cudaSuccess &&
    cudaMemPoolGetAttribute(pool, cudaMemPoolAttrReservedMemCurrent, &reserved) == cudaSuccess &&
    cudaMemPoolGetAttribute(pool, cudaMemPoolAttrUsedMemCurrent, &used) == cudaSuccess)
  {
    free += reserved - used;
  }
  return free;
}
}
