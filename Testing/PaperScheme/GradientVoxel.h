// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_PaperScheme_GradientVoxel_h
#define limpid_testing_PaperScheme_GradientVoxel_h

#include "PaperScheme/PerspectiveMap.h"
#include "PaperScheme/Views.h"

namespace limpid::reference
{
/// What the gradient needs of one eye.
template <class Real>
struct SourceTerm
{
  Real weight = 0;          ///< q or r of Eqs. (23), (24); zero: the grids are not looked at
  PerspectiveMap<Real> map; ///< g_V or g_L of Eqs. (12), (13)
  GridView<const Real> transmittance; ///< T_V or T_L, shape map.cells      [0, 1]
  GridView<const Real> visibleBehind; ///< G_V or G_L, shape map.cells      [1]

  /// Eq. (27) or Eq. (28) at a voxel of importance `importance`.
  Real Derivative(const Vec3Of<Real>& voxel, Real importance) const
  {
    if (!(weight > 0))
    {
      return 0;
    }
    const TrilinearPlace<Real> place = LocateInGrid(transmittance, map.ToCells(map.ToView(voxel)));
    const Real seen = Interpolate(transmittance.values, place);
    const Real behind = Interpolate(visibleBehind.values, place);
    return weight * (behind - importance * seen);
  }
};

/**
 * Derivative of the energy by the extinction of one voxel, Eqs. (26) to (28):
 *
 *   p (mu_t - base) + q (G_V - g T_V) + r (G_L - g T_L)
 *
 * T and G are interpolated trilinearly from the perspective grids. As in the paper, G lacks the
 * weight of the widening rays that the derivative of the volume integral has (deviation D1).
 *
 * One index is one voxel, first axis fastest.
 */
template <class Real>
struct GradientVoxel
{
  Int3 nodes{ 0 };
  const Real* extinction = nullptr;     ///< mu_t, shape nodes        [1/normalised length]
  const Real* baseExtinction = nullptr; ///< base of Eq. (22), nodes    [1/normalised length]
  const Real* importance = nullptr;     ///< g, shape nodes           [0, 1]
  Real regularization = 0;              ///< p of Eq. (22)
  SourceTerm<Real> view;
  SourceTerm<Real> light;
  Real* gradient = nullptr; ///< dF/dmu_t of Eqs. (26)-(28), shape nodes

  void operator()(Index voxel) const
  {
    const Index row = voxel / nodes.x;
    const Index slice = row / nodes.y;
    const Vec3Of<Real> position(Real(voxel % nodes.x), Real(row % nodes.y), Real(slice));
    gradient[voxel] = regularization * (extinction[voxel] - baseExtinction[voxel]) +
      view.Derivative(position, importance[voxel]) + light.Derivative(position, importance[voxel]);
  }
};
}

#endif
