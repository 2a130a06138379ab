// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_methods_Ament2017_h
#define limpid_methods_Ament2017_h

#include "methods/MethodScene.h"

#include <cmath>

namespace limpid
{
/**
 * The share of its base extinction that a node keeps by Ament et al. [AZD17], in closed form:
 *
 *   p / (p + (1 - g)^(2 lambda) (r F + q B)),
 *   F, B = integrals of g^2 dt along the ray in front of the node and behind it, in radii,
 *
 * so that what is important itself stays, and what is not gives way to what it hides (q) or lies
 * behind (r).
 */
struct AmentKeptShare
{
  float exponent;       ///< 2 lambda
  float regularization; ///< p
  float occluders;      ///< q
  float background;     ///< r

  /// `front`, `behind`: [radius].
  LIMPID_HD LIMPID_INLINE float operator()(float importance, float front, float behind) const
  {
    const float unimportant = std::pow(1.0f - importance, this->exponent);
    const float load = unimportant * (this->background * front + this->occluders * behind);
    return this->regularization / (this->regularization + load);
  }
};

/**
 * The extinction by AmentKeptShare for the source, smoothed: every pass makes the kept shares
 * means of their neighbours that have any extinction, with the weights 1, 2, 1 along each axis.
 * Where no importance is in front or behind, the base extinction stays bit for bit without them.
 *
 * `extinction`: in: the base; out [1/length].
 */
template <class AnyDevice>
void FindAment2017(const MethodScene<AnyDevice>& scene, float* extinction);
}

#endif
