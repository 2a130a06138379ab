// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_PaperScheme_AdamVoxel_h
#define limpid_testing_PaperScheme_AdamVoxel_h

#include "math/Vec.h"

#include <cmath>

namespace limpid::reference
{
/**
 * One projected step of Adam [KB17] at one voxel: Eq. (30) with adaptive estimates of the moments,
 * then clamped to the range of Eq. (25).
 */
template <class Real>
struct AdamVoxel
{
  const Real* gradient = nullptr; ///< dF/dmu_t, one per voxel
  Real* firstMoment = nullptr;    ///< running mean of the gradient, one per voxel
  Real* secondMoment = nullptr;   ///< running mean of its square, one per voxel
  Real* extinction = nullptr;     ///< mu_t, one per voxel      [1/normalised length]
  Real majorant = 0;              ///< upper bound of Eq. (25)    [1/normalised length]
  Real stepLength = 0;            ///< learning rate            [1/normalised length]
  Real epsilon = 0;               ///< keeps rounding noise from moving a voxel, unit of gradient
  Real firstCorrection = 1;       ///< 1 / (1 - firstDecay^n) after n steps
  Real secondCorrection = 1;      ///< 1 / (1 - secondDecay^n) after n steps

  static constexpr Real firstDecay = Real(0.9);
  static constexpr Real secondDecay = Real(0.999);

  void operator()(Index voxel) const
  {
    const Real slope = gradient[voxel];
    const Real first = firstDecay * firstMoment[voxel] + (1 - firstDecay) * slope;
    const Real second = secondDecay * secondMoment[voxel] + (1 - secondDecay) * slope * slope;
    firstMoment[voxel] = first;
    secondMoment[voxel] = second;
    const Real change =
      stepLength * first * firstCorrection / (std::sqrt(second * secondCorrection) + epsilon);
    const Real moved = extinction[voxel] - change;
    extinction[voxel] = moved < 0 ? Real(0) : moved > majorant ? majorant : moved;
  }
};
}

#endif
