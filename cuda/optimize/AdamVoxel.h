// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_AdamVoxel_h
#define limpid_optimize_AdamVoxel_h

#include "backend/Simd.h"
#include "optimize/ExtinctionBounds.h"
#include "optimize/Pulls.h"

#include <cmath>

namespace limpid
{
/**
 * One step of Adam [KB17] at every voxel, projected to the bounds; replaces the plain step of Eq.
 * (30).
 *
 * Adam divides the gradient by its own magnitude. Where the true gradient is zero, that would
 * amplify rounding noise. Therefore `floor` is a small fraction of the largest weight, not of the
 * gradient.
 */
template <class Real>
struct AdamVoxel
{
  static constexpr const char* label = "Adam";

  const Real* gradient;      ///< derivative of the visibility terms
  const Real* base;          ///< mu-bar [1/length]
  const Real* importance;    ///< [0, 1]
  Real* first;               ///< running mean of the gradient
  Real* second;              ///< running mean of its square
  Real* extinction;          ///< [1/length]
  PullsAtVoxels<Real> pulls; ///< the regularisation of Eq. (26) and all others
  Real step;                 ///< learning rate, bias of the first moment removed [1/length]
  Real secondCorrection;     ///< 1 / (1 - beta2^n), removes the bias of the second moment
  Real floor;                ///< epsilon
  ExtinctionBounds<Real> bounds;

  LIMPID_HD LIMPID_INLINE void operator()(Index voxel) const
  {
    constexpr Real beta1 = Real(0.9);
    constexpr Real beta2 = Real(0.999);
    const Real now = this->extinction[voxel];
    const Real slope = this->pulls.AddedTo(this->gradient[voxel], now, this->base[voxel], voxel);
    const Real mean = beta1 * this->first[voxel] + (Real(1) - beta1) * slope;
    const Real square = beta2 * this->second[voxel] + (Real(1) - beta2) * slope * slope;
    this->first[voxel] = mean;
    this->second[voxel] = square;
    const Real size = std::sqrt(square * this->secondCorrection) + this->floor;
    const Real wanted = now - this->step * mean / size;
    this->extinction[voxel] =
      this->bounds.Clamp(wanted, this->importance[voxel], this->base[voxel]);
  }
};
}

#endif
