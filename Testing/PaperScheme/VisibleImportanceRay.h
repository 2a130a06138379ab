// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_PaperScheme_VisibleImportanceRay_h
#define limpid_testing_PaperScheme_VisibleImportanceRay_h

#include "PaperScheme/PerspectiveMap.h"
#include "PaperScheme/Views.h"

namespace limpid::reference
{
/**
 * Visible importance behind every sample along one ray.
 *
 * Eqs. (19) and (20) in the paper's discretisation, traversed back to front:
 *
 *   G(i,j,k) = sum_{k'>k} g(i,j,k') mu_t(i,j,k') T(i,j,k') h(i,j)
 *
 * One index is one ray (i,j). The body writes that ray's cells and nothing else.
 */
template <class Real>
struct VisibleImportanceRay
{
  FieldView<Real> extinction;         ///< mu_t, world grid                 [1/normalised length]
  FieldView<Real> importance;         ///< g, world grid                    [0, 1]
  PerspectiveMap<Real> map;           ///< g_V or g_L of Eqs. (12), (13)
  GridView<const Real> transmittance; ///< T_V or T_L, shape map.cells      [0, 1]
  GridView<Real> visibleBehind;       ///< G_V or G_L, shape map.cells      [0, 1 + O(mu_t h)]

  void operator()(Index ray) const
  {
    const int i = static_cast<int>(ray % map.cells.x);
    const int j = static_cast<int>(ray / map.cells.x);
    const Real cellLength = map.CellLength(i, j);
    const Range<int> inBox = SamplesInBox(map, extinction.nodes, i, j);

    Real behind = 0;
    for (int k = map.cells.z - 1; k >= inBox.end; --k)
    {
      visibleBehind(i, j, k) = 0;
    }
    for (int k = inBox.end - 1; k >= inBox.begin; --k)
    {
      visibleBehind(i, j, k) = behind;
      const Vec3Of<Real> position = map.SampleInWorld(i, j, k);
      behind +=
        SampleProduct(importance, extinction, position) * transmittance(i, j, k) * cellLength;
    }
    for (int k = inBox.begin - 1; k >= 0; --k)
    {
      visibleBehind(i, j, k) = behind;
    }
  }
};
}

#endif
