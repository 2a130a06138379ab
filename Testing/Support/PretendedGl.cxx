// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Loaded before OpenGL (LD_PRELOAD), it says what tests want: that the renderer is a graphics card,
// and, once, to a library of Limpid, that memory is out.

#include <atomic>
#include <cstring>

#include <dlfcn.h>

namespace
{
constexpr unsigned outOfMemory = 0x0505;
constexpr unsigned renderer = 0x1F01;
std::atomic<long> questions{ 0 }; ///< of ours for errors, until there is one; 0: there is none
std::atomic<bool> isCard{ false };

template <class Function>
Function Actual(const char* name)
{
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

/// Returns whether an address is in a library of Limpid. VTK asks for errors, too.
bool IsOurs(const void* address)
{
  Dl_info where;
  return dladdr(address, &where) != 0 && std::strstr(where.dli_fname, "Limpid") != nullptr;
}
}

extern "C"
{
  /// Makes the `number`-th question for errors from now on return one.
  void limpid_fail_gl(long number)
  {
    questions = number;
  }

  /// Returns whether it has been asked.
  int limpid_gl_has_failed()
  {
    return questions == 0 ? 1 : 0;
  }

  void limpid_pretend_card(int pretend)
  {
    isCard = pretend != 0;
  }

  unsigned glGetError()
  {
    if (questions > 0 && IsOurs(__builtin_return_address(0)) && --questions == 0)
    {
      return outOfMemory;
    }
    static const auto actual = Actual<unsigned (*)()>("glGetError");
    return actual ? actual() : 0;
  }

  const unsigned char* glGetString(unsigned name)
  {
    if (isCard && name == renderer)
    {
      return reinterpret_cast<const unsigned char*>("A card");
    }
    static const auto actual = Actual<const unsigned char* (*)(unsigned)>("glGetString");
    return actual ? actual(name) : nullptr;
  }
}
