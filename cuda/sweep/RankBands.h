// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_RankBands_h
#define limpid_sweep_RankBands_h

#include "backend/Communicator.h"
#include "sweep/EvenBands.h"
#include "sweep/FaceFrustum.h"
#include "sweep/RaySteps.h"

#include <cstddef>
#include <vector>

namespace limpid
{
class SliceWindow;

/**
 * A frustum shared by ranks, each of which has a band of consecutive rows of rays, and of the
 * voxels of each slice those beside its rays. The arithmetic of a row is that of one process, so
 * that results are the same bit by bit; what rows of neighbours read of each other travels slice by
 * slice (Documentation/Method.md, section on ranks).
 *
 * Ranks wait for each other on every slice, and what matters lies elsewhere on each: so bands move
 * from stretch to stretch (EvenBands.h), and rays go to their next rank with all that they carry.
 * Between sweeps they are where the last slice has them.
 */
class RankBands
{
public:
  /// The frustum's tables and the ranks have to stay. Where no voxels are planned, nobody waits,
  /// and bands stay where they are.
  RankBands(const FaceFrustum& frustum, const Communicator& ranks);

  const Communicator& Ranks() const { return *this->All; }

  /// Rows of rays of a rank on slice `s`.
  Range<int> RaysOf(int rank, int s) const
  {
    const std::vector<int>& begins = this->Begins[std::size_t(s / slicesPerStretch)];
    return { begins[std::size_t(rank)], begins[std::size_t(rank) + 1] };
  }

  /// Rows of voxels of slice `s` that a rank changes, of those that the frustum owns.
  Range<int> VoxelsOf(int rank, int s) const;

  /// Rows of voxels at a node of the depth axis that the rays of a rank read, or that it changes;
  /// empty: none.
  Range<int> VoxelsNeeded(int rank, int node) const
  {
    return this->Needed[std::size_t(rank)][std::size_t(node)];
  }

  /// Rows of rays that this rank has on any slice, or reads.
  const Range<int>& RaysReached() const { return this->Reached; }

  /// Nodes along the depth axis, as far as the frustum goes.
  int Depth() const { return static_cast<int>(this->Needed.front().size()); }

  /// Brings rays from the ranks that have them on a slice to those that have them on another, with
  /// so many values each.
  void PassRays(int from, int to, const std::vector<RayValues>& carried) const;

  /// Brings images of the rays to all ranks whose voxels of slice `s` read them. `cubic`: whether
  /// voxels read a row more on either side.
  void ExchangeRays(int s, bool cubic, const std::vector<float*>& images) const;

  /// Brings the rows of slice `s` to all ranks whose rays read them from those that change them.
  void ExchangeVoxels(int s, const std::vector<SliceWindow*>& fields) const;

private:
  /// Rows that go to another rank or come from there.
  struct Passing
  {
    int rank;
    Range<int> rows;
  };

  /// What passes on a slice.
  struct OnSlice
  {
    std::vector<Passing> sent;
    std::vector<Passing> received;
  };

  Range<int> RowsRead(const Range<int>& rays, int s) const;
  Range<int> RaysReadBy(int rank, int s, int more) const;
  void FindNeeded();
  void FindVisited();
  template <class Had, class Read>
  OnSlice Pass(const Had& had, const Read& read) const;
  template <class Add>
  void Exchange(const OnSlice& passing, const Add& add) const;

  FaceFrustum Frustum;
  const Communicator* All;
  std::vector<std::vector<int>> Begins;        ///< see FindEvenBands
  std::vector<std::vector<Range<int>>> Needed; ///< [rank][node]
  Range<int> Reached;
  std::vector<Range<int>> Visited; ///< [row]: columns that are active on any slice
  std::vector<OnSlice> Rays[2];    ///< [cubic][slice]
  std::vector<OnSlice> Voxels;     ///< [slice]
};
}

#endif
