// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_MostExtinction_h
#define limpid_energy_MostExtinction_h

#include "math/Macros.h"

namespace limpid
{
/**
 * The upper bound of the extinction: mu-bar + epsilon (majorant - mu-bar) with the base extinction
 * mu-bar. It equals the base exactly for epsilon = 0 and the majorant for 1. In between, rounding
 * puts it neither below the base nor above the majorant. Otherwise it is linear, so its samples
 * follow from samples of the base extinction.
 */
template <class Real>
struct MostExtinction
{
  Real emphasis; ///< epsilon [0, 1]
  Real majorant; ///< [1/length]

  LIMPID_HD LIMPID_INLINE Real operator()(Real base) const
  {
    const Real between = (Real(1) - this->emphasis) * base + this->emphasis * this->majorant;
    const Real most = between > base ? between : base;
    return most < this->majorant ? most : this->majorant;
  }
};
}

#endif
