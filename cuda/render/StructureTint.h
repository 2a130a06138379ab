// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Colours of samples by their structures.

#ifndef limpid_render_StructureTint_h
#define limpid_render_StructureTint_h

#include "render/RayPlaces.h"

namespace limpid
{
/// Returns the row whose nodes have the largest sum of trilinear weights in a cell; of equal sums,
/// that of the first node. Borders are thus smooth between nodes, and no row appears that none of
/// the nodes has. `first`: row of the first node; x, y, z: fractions of the cell.
LIMPID_HD LIMPID_INLINE StructureRow RowInCell(
  const CellGrid& grid, const StructureRow* first, float x, float y, float z)
{
  StructureRow rows[8];
  float weights[8];
  bool areSame = true;
  LIMPID_UNROLL(8)
  for (int node = 0; node < 8; ++node)
  {
    const int far[3] = { node & 1, node >> 1 & 1, node >> 2 };
    rows[node] = first[far[0] + far[1] * grid.stride[1] + far[2] * grid.stride[2]];
    weights[node] =
      (far[0] != 0 ? x : 1.0f - x) * (far[1] != 0 ? y : 1.0f - y) * (far[2] != 0 ? z : 1.0f - z);
    areSame = areSame && rows[node] == rows[0];
  }
  StructureRow best = rows[0];
  float most = 0;
  LIMPID_UNROLL(8)
  for (int node = 0; node < 8 && !areSame; ++node)
  {
    float sum = 0;
    LIMPID_UNROLL(8)
    for (int other = 0; other < 8; ++other)
    {
      sum += rows[other] == rows[node] ? weights[other] : 0.0f;
    }
    best = sum > most ? rows[node] : best;
    most = AtLeast(sum, most);
  }
  return best;
}

/// The colours of the structures in which the middles of segments lie, see RayScene::tints.
template <class AnySampler>
class SegmentTints
{
public:
  using Lanes = typename AnySampler::Lanes;
  using Optical = typename AnySampler::Optical;

  /// `middles`: distances of the middles from the entry [samples].
  LIMPID_HD LIMPID_INLINE SegmentTints(const RayScene& scene, const Ray& ray, const Lanes& middles)
  {
    RayPlaces<AnySampler> place;
    place.SetAt(scene, ray, middles);
    const CellPlaces<AnySampler>& at = place.scalars;
    for (int i = 0; i < AnySampler::count; ++i)
    {
      const StructureRow row =
        RowInCell(scene.grid, scene.structures + AnySampler::CellOf(at.cell, i),
          LaneOf(at.fraction[0], i), LaneOf(at.fraction[1], i), LaneOf(at.fraction[2], i));
      this->All[i] = AnySampler::Loaded(scene.tints[row]);
    }
  }

  /// Tints a multiple of the transfer function's colour. `factor`: this multiple.
  LIMPID_HD LIMPID_INLINE Optical Over(int i, float factor, const Optical& color) const
  {
    const Optical& tint = this->All[i];
    return (1.0f - tint[0]) * color + factor * tint;
  }

private:
  Optical All[AnySampler::count];
};
}

#endif
