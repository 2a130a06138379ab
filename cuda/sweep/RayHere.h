// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_RayHere_h
#define limpid_sweep_RayHere_h

#include "sweep/RayChannels.h"

namespace limpid
{
namespace detail
{
/// The values of one ray, kept in registers.
struct RayHere
{
  double toSlice = 0;
  double collected = 0;
  float channels[int(RayChannel::Count)] = {};

  LIMPID_HD LIMPID_INLINE RayStates States()
  {
    return { &this->toSlice, &this->collected, this->channels, 1 };
  }
};
}
}

#endif
