// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/HostDevice.h"

#include "backend/LargePages.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>

namespace limpid
{
std::shared_ptr<HostDevice> HostDevice::Shared()
{
  static const auto shared = std::make_shared<HostDevice>();
  return shared;
}

namespace
{
/// Copies bytes; the addresses may be null if there are none.
void CopyBytes(void* to, const void* from, std::size_t bytes)
{
  if (bytes > 0)
  {
    std::memcpy(to, from, bytes);
  }
}
}

void* HostDevice::Allocate(std::size_t bytes, const char*)
{
  void* memory = this->Take(std::malloc(std::max<std::size_t>(bytes, 1)), bytes);
  UseLargePages(memory, bytes);
  return memory;
}

void* HostDevice::AllocateZeros(std::size_t bytes, const char*)
{
  return this->Take(AllocateZeroPages(std::max<std::size_t>(bytes, 1)), bytes);
}

void* HostDevice::Take(void* memory, std::size_t bytes)
{
  if (!memory)
  {
    throw std::bad_alloc();
  }
  this->Memory.Add(bytes);
  return memory;
}

void HostDevice::Free(void* memory, std::size_t bytes) noexcept
{
  std::free(memory);
  this->Memory.Remove(bytes);
}

void HostDevice::Upload(void* to, const void* from, std::size_t bytes)
{
  const Timed timed(this->Times, { "upload", double(bytes) });
  CopyBytes(to, from, bytes);
}

void HostDevice::Download(void* to, const void* from, std::size_t bytes)
{
  const Timed timed(this->Times, { "download", double(bytes) });
  CopyBytes(to, from, bytes);
}

void HostDevice::Copy(void* to, const void* from, std::size_t bytes)
{
  const Timed timed(this->Times, { "copy", double(bytes) });
  CopyBytes(to, from, bytes);
}

void HostDevice::SetZero(void* memory, std::size_t bytes)
{
  const Timed timed(this->Times, { "set to zero", double(bytes) });
  std::memset(memory, 0, bytes);
}
}
