// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "FailingAllocations.h"

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <new>

#include <link.h>

// Functions of the linker's option --wrap.
extern "C"
{
  void* __real_malloc(std::size_t bytes);
  void* __real_calloc(std::size_t count, std::size_t bytes);
  void __real_free(void* memory);
  void* __wrap_malloc(std::size_t bytes);
  void* __wrap_calloc(std::size_t count, std::size_t bytes);
  void __wrap_free(void* memory);
}

namespace limpid
{
namespace
{
constexpr std::int64_t Never = std::numeric_limits<std::int64_t>::max();

std::atomic<std::int64_t> firstToFail{ Never };
std::atomic<std::int64_t> lastToFail{ Never };
std::atomic<std::int64_t> made{ 0 };
std::atomic<std::int64_t> live{ 0 };

std::uintptr_t callerBegin = 0; ///< addresses of the code that counts; both 0: all
std::uintptr_t callerEnd = 0;
std::size_t leastBytes = 0; ///< that count

/// Looks for a library by a part of its name.
int FindCaller(dl_phdr_info* library, std::size_t, void* name)
{
  if (!std::strstr(library->dlpi_name, static_cast<const char*>(name)))
  {
    return 0;
  }
  for (int i = 0; i < library->dlpi_phnum; ++i)
  {
    const auto& segment = library->dlpi_phdr[i];
    if (segment.p_type == PT_LOAD && (segment.p_flags & PF_X))
    {
      callerBegin = library->dlpi_addr + segment.p_vaddr;
      callerEnd = callerBegin + segment.p_memsz;
    }
  }
  return 1;
}

/// `bytes`: of the allocation; `caller`: address of the code that allocates.
bool Fails(std::size_t bytes, const void* caller)
{
  const auto address = reinterpret_cast<std::uintptr_t>(caller);
  if (bytes < leastBytes)
  {
    return false;
  }
  if (callerEnd > 0 && (address < callerBegin || address >= callerEnd))
  {
    return false;
  }
  const std::int64_t number = ++made;
  return number >= firstToFail && number <= lastToFail;
}

void* Counted(void* memory)
{
  live += memory ? 1 : 0;
  return memory;
}

void* AllocateOrThrow(std::size_t bytes, const void* caller)
{
  void* memory = Fails(bytes, caller) ? nullptr : Counted(__real_malloc(bytes ? bytes : 1));
  if (!memory)
  {
    throw std::bad_alloc();
  }
  return memory;
}

void* AllocateAligned(std::size_t bytes, std::align_val_t alignment, const void* caller)
{
  const auto unit = static_cast<std::size_t>(alignment);
  const std::size_t size = (bytes + unit - 1) / unit * unit;
  void* memory =
    Fails(bytes, caller) ? nullptr : Counted(std::aligned_alloc(unit, size ? size : unit));
  if (!memory)
  {
    throw std::bad_alloc();
  }
  return memory;
}

void Release(void* memory) noexcept
{
  live -= memory ? 1 : 0;
  __real_free(memory);
}
}

FailingAllocations::FailingAllocations(std::int64_t number, Which which, const Scope& scope)
{
  callerBegin = callerEnd = 0;
  leastBytes = scope.leastBytes;
  if (scope.caller)
  {
    dl_iterate_phdr(FindCaller, const_cast<char*>(scope.caller));
  }
  made = 0;
  lastToFail = which == Which::One ? number : Never;
  firstToFail = number;
}

FailingAllocations::~FailingAllocations()
{
  firstToFail = Never;
}

bool FailingAllocations::Failed() const
{
  return made >= firstToFail;
}

std::int64_t LiveBlocks()
{
  return live;
}
}

void* __wrap_malloc(std::size_t bytes)
{
  return limpid::Fails(bytes, __builtin_return_address(0)) ? nullptr
                                                           : limpid::Counted(__real_malloc(bytes));
}

void* __wrap_calloc(std::size_t count, std::size_t bytes)
{
  return limpid::Fails(count * bytes, __builtin_return_address(0))
    ? nullptr
    : limpid::Counted(__real_calloc(count, bytes));
}

void __wrap_free(void* memory)
{
  limpid::Release(memory);
}

void* operator new(std::size_t bytes)
{
  return limpid::AllocateOrThrow(bytes, __builtin_return_address(0));
}

void* operator new[](std::size_t bytes)
{
  return limpid::AllocateOrThrow(bytes, __builtin_return_address(0));
}

void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept
{
  return __wrap_malloc(bytes ? bytes : 1);
}

void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept
{
  return __wrap_malloc(bytes ? bytes : 1);
}

void* operator new(std::size_t bytes, std::align_val_t alignment)
{
  return limpid::AllocateAligned(bytes, alignment, __builtin_return_address(0));
}

void* operator new[](std::size_t bytes, std::align_val_t alignment)
{
  return limpid::AllocateAligned(bytes, alignment, __builtin_return_address(0));
}

void operator delete(void* memory) noexcept
{
  limpid::Release(memory);
}

void operator delete[](void* memory) noexcept
{
  limpid::Release(memory);
}

void operator delete(void* memory, std::size_t) noexcept
{
  limpid::Release(memory);
}

void operator delete[](void* memory, std::size_t) noexcept
{
  limpid::Release(memory);
}

void operator delete(void* memory, std::align_val_t) noexcept
{
  limpid::Release(memory);
}

void operator delete[](void* memory, std::align_val_t) noexcept
{
  limpid::Release(memory);
}

void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
  limpid::Release(memory);
}

void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept
{
  limpid::Release(memory);
}
