// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_PaperScheme_ScoreRay_h
#define limpid_testing_PaperScheme_ScoreRay_h

#include "PaperScheme/PerspectiveMap.h"
#include "PaperScheme/Views.h"

namespace limpid::reference
{
/**
 * What the cells along one ray contribute to the visibility score.
 *
 * Eq. (32) as a Riemann sum over the cells of the perspective grid: g mu_t T_V at a cell's sample,
 * times the volume of Eq. (13)'s Jacobian there.
 *
 * One index is one ray (i,j). The body writes that ray's score and nothing else.
 */
template <class Real>
struct ScoreRay
{
  FieldView<Real> extinction;         ///< mu_t, world grid                 [1/normalised length]
  FieldView<Real> importance;         ///< g, world grid                    [0, 1]
  PerspectiveMap<Real> map;           ///< g_V of Eqs. (12), (13)
  GridView<const Real> transmittance; ///< T_V, shape map.cells             [0, 1]
  double* scores = nullptr;           ///< S of every ray, shape (X, Y)     [normalised length^2]

  void operator()(Index ray) const
  {
    const int i = static_cast<int>(ray % map.cells.x);
    const int j = static_cast<int>(ray / map.cells.x);

    const Range<int> inBox = SamplesInBox(map, extinction.nodes, i, j);
    double score = 0;
    for (int k = inBox.begin; k < inBox.end; ++k)
    {
      const Vec3Of<Real> position = map.SampleInWorld(i, j, k);
      score += double(SampleProduct(importance, extinction, position) * transmittance(i, j, k) *
        map.CellVolume(k));
    }
    scores[ray] = score;
  }
};
}

#endif
