// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_RankBands_h
#define limpid_sweep_RankBands_h

#include "backend/Communicator.h"
#include "sweep/FaceFrustum.h"

#include <vector>

namespace limpid
{
class SliceWindow;

/**
 * A frustum shared by ranks: each has a band of consecutive rows of rays, and of the voxels of each
 * slice those beside its rays. The arithmetic of a row is that of one process, so that results are
 * the same bit by bit; what rows of neighbours read of each other travels slice by slice
 * (Documentation/Method.md, section on ranks).
 *
 * Bands have about the same number of samples that matter.
 */
class RankBands
{
public:
  /// The frustum's tables and the ranks have to stay. Voxels have to be planned, too.
  RankBands(const FaceFrustum& frustum, const Communicator& ranks);

  const Communicator& Ranks() const { return *this->All; }

  /// Rows of rays of a rank.
  Range<int> RaysOf(int rank) const
  {
    return { this->Begins[std::size_t(rank)], this->Begins[std::size_t(rank) + 1] };
  }

  /// Rows of voxels of slice `s` that a rank changes, of those that the frustum owns.
  Range<int> VoxelsOf(int rank, int s) const;

  /// Nodes along the depth axis, as far as the frustum goes.
  int Depth() const { return static_cast<int>(this->Needed.front().size()); }

  /// Rows of voxels at a node of the depth axis that the rays of a rank read, or that it changes;
  /// empty: none.
  Range<int> VoxelsNeeded(int rank, int node) const
  {
    return this->Needed[std::size_t(rank)][std::size_t(node)];
  }

  /// Rows of rays that voxels of a rank read on slice `s`, so many more on either side of those
  /// that they are interpolated from.
  Range<int> RaysReadBy(int rank, int s, int more) const;

  /// Brings images of the rays, one value per ray, to all ranks whose voxels of slice `s` read
  /// them. `more`: see RaysReadBy.
  void ExchangeRays(int s, int more, const std::vector<float*>& images) const;

  /// Brings the rows of slice `s` to all ranks whose rays read them from those that change them.
  void ExchangeVoxels(int s, const std::vector<SliceWindow*>& fields) const;

private:
  Range<int> RowsRead(const Range<int>& rays, int s) const;

  FaceFrustum Frustum;
  const Communicator* All;
  std::vector<int> Begins;                     ///< of the ranks' rows, and behind the last one
  std::vector<std::vector<Range<int>>> Needed; ///< [rank][node]
};
}

#endif
