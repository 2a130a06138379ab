// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_WideLoad_h
#define limpid_backend_WideLoad_h

#include "math/Macros.h"

#include <cstring>
#include <type_traits>

namespace limpid
{
/// Returns a copy of a value that is aligned to its size: 4, 8 or 16 bytes. On a GPU it is read by
/// one load, where nvcc would load each member by itself.
template <class Value>
LIMPID_HD LIMPID_INLINE Value LoadAtOnce(const Value& from)
{
#ifdef __CUDA_ARCH__
  static_assert(alignof(Value) == sizeof(Value) && sizeof(Value) <= 16, "no load of that size");
  using Bits = std::conditional_t<sizeof(Value) == 4, unsigned,
    std::conditional_t<sizeof(Value) == 8, uint2, uint4>>;
  const Bits bits = *reinterpret_cast<const Bits*>(&from);
  Value value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
#else
  return from;
#endif
}
}

#endif
