// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/CudaDevice.h"

#include "backend/Choice.h"
#include "math/Require.h"

#include <algorithm>
#include <mutex>
#include <string>

namespace limpid
{
void detail::RequireCuda(cudaError_t status, const char* call)
{
  if (status == cudaSuccess)
  {
    return;
  }
  cudaGetLastError(); // clears the error, which is reported here
  throw DeviceError(std::string("CUDA reports \"") + cudaGetErrorString(status) + "\" (" + call +
    "; the result would be wrong). Use the backend CPU, and report this if it happens again.");
}

std::shared_ptr<CudaDevice> CudaDevice::Shared()
{
  static std::mutex mutex;
  static std::weak_ptr<CudaDevice> shared;
  const std::lock_guard<std::mutex> lock(mutex);
  std::shared_ptr<CudaDevice> device = shared.lock();
  if (!device)
  {
    device = std::make_shared<CudaDevice>(FindCuda().device);
    shared = device;
  }
  return device;
}

CudaDevice::CudaDevice(int number)
  : Number(number)
{
  cudaDeviceProp properties{};
  LIMPID_CUDA(cudaSetDevice(number));
  LIMPID_CUDA(cudaGetDeviceProperties(&properties, number));
  this->Title = std::string("CUDA, ") + properties.name;
  this->Processors = properties.multiProcessorCount;
  this->MostBlocks = Index(this->Processors) * 16;
  LIMPID_CUDA(cudaStreamCreateWithFlags(&this->Stream, cudaStreamNonBlocking));
  this->Staged = std::make_unique<StagedCopies>(this->Stream);
  cudaMemPool_t pool{};
  LIMPID_CUDA(cudaDeviceGetDefaultMemPool(&pool, number));
  std::uint64_t keep = UINT64_MAX; // until Trim
  LIMPID_CUDA(cudaMemPoolSetAttribute(pool, cudaMemPoolAttrReleaseThreshold, &keep));
}

CudaDevice::~CudaDevice()
{
  this->Trim();
  this->Staged.reset(); // before its stream
  cudaStreamDestroy(this->Stream);
}

void CudaDevice::Trim() noexcept
{
  cudaSetDevice(this->Number);
  cudaStreamSynchronize(this->Stream); // what is freed may still be in use
  cudaMemPool_t pool{};
  if (cudaDeviceGetDefaultMemPool(&pool, this->Number) == cudaSuccess)
  {
    cudaMemPoolTrimTo(pool, 0);
  }
}

void CudaDevice::Use() const
{
  LIMPID_CUDA(cudaSetDevice(this->Number));
}

void* CudaDevice::Allocate(std::size_t bytes, const char* what)
{
  void* memory = nullptr;
  this->Use();
  const cudaError_t status =
    cudaMallocAsync(&memory, std::max<std::size_t>(bytes, 1), this->Stream);
  if (status == cudaErrorMemoryAllocation)
  {
    cudaGetLastError();
    std::size_t free = 0;
    std::size_t total = 0;
    LIMPID_CUDA(cudaMemGetInfo(&free, &total));
    const auto megabytes = [](std::size_t size) { return std::to_string(size / 1000000); };
    throw DeviceError("The GPU cannot allocate " + megabytes(bytes) + " MB for " + what + " (" +
      megabytes(free) + " of " + megabytes(total) +
      " MB are free). Use a smaller volume or the backend CPU.");
  }
  LIMPID_CUDA(status);
  this->Memory.Add(bytes);
  return memory;
}

void* CudaDevice::AllocateZeros(std::size_t bytes, const char* what)
{
  void* memory = this->Allocate(bytes, what);
  this->SetZero(memory, bytes);
  return memory;
}

void CudaDevice::Free(void* memory, std::size_t bytes) noexcept
{
  cudaFreeAsync(memory, this->Stream);
  this->Memory.Remove(bytes);
  if (this->Memory.Bytes() == 0)
  {
    this->Trim();
  }
}

void CudaDevice::Upload(void* to, const void* from, std::size_t bytes)
{
  this->Use();
  const Timed timed(*this, { "upload", double(bytes) });
  this->Staged->Upload(to, from, bytes);
}

void CudaDevice::Download(void* to, const void* from, std::size_t bytes)
{
  this->Use();
  const Timed timed(*this, { "download", double(bytes) });
  this->Staged->Download(to, from, bytes);
}

void CudaDevice::Copy(void* to, const void* from, std::size_t bytes)
{
  this->Use();
  const Timed timed(*this, { "copy", double(bytes) });
  LIMPID_CUDA(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToDevice, this->Stream));
}

void CudaDevice::SetZero(void* memory, std::size_t bytes)
{
  this->Use();
  const Timed timed(*this, { "set to zero", double(bytes) });
  LIMPID_CUDA(cudaMemsetAsync(memory, 0, bytes, this->Stream));
}

void CudaDevice::Wait()
{
  LIMPID_CUDA(cudaStreamSynchronize(this->Stream));
}

void CudaDevice::Time(LaunchTimes* times)
{
  this->Use();
  if (this->Events)
  {
    this->Wait();
    this->Events->Collect();
  }
  this->Events = times ? std::make_unique<LaunchEvents>(*times, this->Stream) : nullptr;
}
}
