// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_PaperScheme_TransmittanceRay_h
#define limpid_testing_PaperScheme_TransmittanceRay_h

#include "PaperScheme/PerspectiveMap.h"
#include "PaperScheme/Views.h"

#include <cmath>

namespace limpid::reference
{
/**
 * Transmittance from the eye to every sample along one ray.
 *
 * Discretises Eqs. (15) and (16) as Eqs. (17) and (18), a left Riemann sum, with the product of
 * exponentials written as the exponential of a sum:
 *
 *   T(i,j,k) = exp( - sum_{k'<k} mu_t(i,j,k') h(i,j) )
 *
 * One index is one ray (i,j). The body writes that ray's cells and nothing else.
 */
template <class Real>
struct TransmittanceRay
{
  FieldView<Real> extinction;   ///< mu_t, world grid                 [1/normalised length]
  PerspectiveMap<Real> map;     ///< g_V or g_L of Eqs. (12), (13)
  GridView<Real> transmittance; ///< T_V or T_L, shape map.cells      [0, 1]

  void operator()(Index ray) const
  {
    const int i = static_cast<int>(ray % map.cells.x);
    const int j = static_cast<int>(ray / map.cells.x);
    const Real cellLength = map.CellLength(i, j);
    const Range<int> inBox = SamplesInBox(map, extinction.nodes, i, j);

    Real opticalDepth = 0; // from the near plane; there is nothing in front of it
    for (int k = 0; k < inBox.begin; ++k)
    {
      transmittance(i, j, k) = 1;
    }
    for (int k = inBox.begin; k < inBox.end; ++k)
    {
      transmittance(i, j, k) = std::exp(-opticalDepth);
      opticalDepth += Sample(extinction, map.SampleInWorld(i, j, k)) * cellLength;
    }
    const Real behindBox = std::exp(-opticalDepth);
    for (int k = inBox.end; k < map.cells.z; ++k)
    {
      transmittance(i, j, k) = behindBox;
    }
  }
};
}

#endif
