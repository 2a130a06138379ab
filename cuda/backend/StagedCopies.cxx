// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// For the CUDA compiler.

#include "backend/StagedCopies.h"

#include "backend/Backend.h"
#include "backend/CudaDevice.h"

#include <algorithm>
#include <cstring>

namespace limpid
{
namespace
{
unsigned char* After(void* memory, std::size_t bytes)
{
  return static_cast<unsigned char*>(memory) + bytes;
}

const unsigned char* After(const void* memory, std::size_t bytes)
{
  return static_cast<const unsigned char*>(memory) + bytes;
}

/// Copies within the host's memory by several threads.
void CopyOnHost(void* to, const void* from, std::size_t bytes)
{
  constexpr std::size_t piece = std::size_t(256) << 10;
  ParallelFor(static_cast<Index>((bytes + piece - 1) / piece),
    [&](Index number)
    {
      const std::size_t begin = static_cast<std::size_t>(number) * piece;
      std::memcpy(After(to, begin), After(from, begin), std::min(piece, bytes - begin));
    });
}
}

StagedCopies::~StagedCopies()
{
  for (const Room& room : this->Rooms)
  {
    if (room.copied)
    {
      cudaEventDestroy(room.copied);
    }
    cudaFreeHost(room.memory);
  }
}

void StagedCopies::Prepare()
{
  for (Room& room : this->Rooms)
  {
    if (!room.memory)
    {
      LIMPID_CUDA(cudaMallocHost(&room.memory, roomBytes));
    }
    if (!room.copied)
    {
      LIMPID_CUDA(cudaEventCreateWithFlags(&room.copied, cudaEventDisableTiming));
    }
  }
}

void StagedCopies::Upload(void* to, const void* from, std::size_t bytes)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Prepare();
  for (std::size_t begin = 0; begin < bytes; begin += roomBytes, ++this->Next)
  {
    const Room& room = this->Rooms[this->Next % 2];
    const std::size_t length = std::min(roomBytes, bytes - begin);
    LIMPID_CUDA(cudaEventSynchronize(room.copied));
    CopyOnHost(room.memory, After(from, begin), length);
    LIMPID_CUDA(
      cudaMemcpyAsync(After(to, begin), room.memory, length, cudaMemcpyHostToDevice, this->Stream));
    LIMPID_CUDA(cudaEventRecord(room.copied, this->Stream));
  }
}

void StagedCopies::Download(void* to, const void* from, std::size_t bytes)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Prepare();
  const auto begin = [&](std::size_t at, const Room& room)
  {
    LIMPID_CUDA(cudaMemcpyAsync(room.memory, After(from, at), std::min(roomBytes, bytes - at),
      cudaMemcpyDeviceToHost, this->Stream));
    LIMPID_CUDA(cudaEventRecord(room.copied, this->Stream));
  };
  if (bytes > 0)
  {
    begin(0, this->Rooms[this->Next % 2]);
  }
  for (std::size_t at = 0; at < bytes; at += roomBytes, ++this->Next)
  {
    if (at + roomBytes < bytes)
    {
      begin(at + roomBytes, this->Rooms[(this->Next + 1) % 2]);
    }
    const Room& room = this->Rooms[this->Next % 2];
    LIMPID_CUDA(cudaEventSynchronize(room.copied));
    CopyOnHost(After(to, at), room.memory, std::min(roomBytes, bytes - at));
  }
}
}
