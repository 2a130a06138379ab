// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_methods_Ament2017_h
#define limpid_methods_Ament2017_h

#include "methods/MethodScene.h"

#include <cmath>

namespace limpid
{
/**
 * The share of its base extinction that a node keeps according to Ament et al. [AZD17], in closed
 * form:
 *
 *    p / (p + (1 - g)^(2 lambda) (r F + q B))
 *
 * F and B are the integrals of g^2 dt along the ray in front of the node and behind it [radius].
 * Important structures stay. Others are reduced if they hide important ones (q) or lie behind them
 * (r).
 */
struct AmentKeptShare
{
  float exponent;       ///< 2 lambda
  float regularization; ///< p
  float occluders;      ///< q
  float background;     ///< r

  /// `front`, `behind`: integrals F and B [radius].
  LIMPID_HD LIMPID_INLINE float operator()(float importance, float front, float behind) const
  {
    const float unimportant = std::pow(1.0f - importance, this->exponent);
    const float load = unimportant * (this->background * front + this->occluders * behind);
    return this->regularization / (this->regularization + load);
  }
};

/**
 * Computes the extinction by AmentKeptShare for the source, with smoothing: each pass replaces the
 * kept shares by means over neighbours with nonzero extinction, with the weights 1, 2, 1 along
 * each axis. Without smoothing, the base extinction is kept bit by bit where no importance is in
 * front or behind.
 *
 * `extinction`: in: the base extinction, out: the result [1/length].
 */
template <class AnyDevice>
void FindAment2017(const MethodScene<AnyDevice>& scene, float* extinction);
}

#endif
