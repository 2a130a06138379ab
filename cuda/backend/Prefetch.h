// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_Prefetch_h
#define limpid_backend_Prefetch_h

#include "math/Macros.h"

namespace limpid
{
/// Prefetches GPU memory into the L2 cache, asynchronously.
LIMPID_HD LIMPID_INLINE void PrefetchOnDevice([[maybe_unused]] const void* address)
{
#ifdef __CUDA_ARCH__
  asm volatile("prefetch.global.L2 [%0];" : : "l"(__cvta_generic_to_global(address)));
#endif
}
}

#endif
