// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_MostExtinction_h
#define limpid_energy_MostExtinction_h

#include "math/Number.h"

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

  /// `Number`: Real, or several side by side.
  template <class Number>
  LIMPID_HD LIMPID_INLINE Number operator()(const Number& base) const
  {
    const Number between = (Real(1) - this->emphasis) * base + this->emphasis * this->majorant;
    return AtMost(Select(between > base, between, base), this->majorant);
  }
};
}

#endif
