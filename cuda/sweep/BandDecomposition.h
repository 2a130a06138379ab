// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_BandDecomposition_h
#define limpid_sweep_BandDecomposition_h

#include "distributed/Communicator.h"
#include "scene/FieldView.h"
#include "sweep/EvenBands.h"
#include "sweep/FaceFrustum.h"

#include <cstddef>
#include <vector>

namespace limpid
{
struct SliceWindow;

/// One kind of ray values, as bytes, to be redistributed.
struct RayValues
{
  std::byte* first;
  std::size_t bytes; ///< of one ray's value

  template <class Value>
  RayValues(Value* values)
    : first(reinterpret_cast<std::byte*>(values))
    , bytes(sizeof(Value))
  {
  }
};

/**
 * The decomposition of a frustum among ranks. A subdomain is a band of consecutive rows of rays
 * with, on each slice, the rows of voxels next to them. Each row is computed as by a single
 * process, so results are bit-identical. Ghost rows are exchanged slice by slice
 * (Documentation/Method.md, section on ranks).
 *
 * Ranks wait for each other on every slice, and the active region differs between slices. The
 * decomposition therefore changes between stretches (EvenBands.h), and rays are redistributed with
 * all values that they carry. Between sweeps they are distributed as on the last slice.
 *
 * A process alone has one band of all rows, in one stretch, and exchanges nothing.
 */
class BandDecomposition
{
public:
  /// `frustum` (its tables) and `ranks` must outlive this object. Without tables of voxels ranks
  /// do not wait on slices, and one decomposition serves all of them.
  BandDecomposition(const FaceFrustum& frustum, const Communicator& ranks);

  const Communicator& Ranks() const { return *this->All; }

  /// Rows of rays that a rank owns on slice `s`.
  Range<int> RaysOf(int rank, int s) const
  {
    const std::vector<int>& begins = this->Begins[std::size_t(s / this->SlicesPerStretch)];
    return { begins[std::size_t(rank)], begins[std::size_t(rank) + 1] };
  }

  /// Returns the end of the stretch of slices with slice `s`, see EvenBands.h.
  int EndOfStretch(int s) const
  {
    return (s / this->SlicesPerStretch + 1) * this->SlicesPerStretch;
  }

  /// Rows of voxels of slice `s` that a rank owns, out of those that the frustum owns.
  Range<int> VoxelsOf(int rank, int s) const;

  /// Rows of voxels at a node of the depth axis that a rank owns or whose values its rays read;
  /// may be empty.
  Range<int> VoxelsNeeded(int rank, int node) const
  {
    return this->Needed[std::size_t(rank)][std::size_t(node)];
  }

  /// Owned rows of rays on a slice.
  Range<int> RaysHere(int s) const { return this->RaysOf(this->All->Rank(), s); }

  /// Owned rows of voxels of a slice.
  Range<int> VoxelsHere(int s) const { return this->VoxelsOf(this->All->Rank(), s); }

  /// Rows of voxels at a node of the depth axis that are owned or that owned rays read.
  Range<int> VoxelsNeededHere(int node) const
  {
    return this->VoxelsNeeded(this->All->Rank(), node);
  }

  /// Sums over all ranks.
  void SumOverAll(ExactSum* sums, std::size_t count) const { this->All->Sum(sums, count); }

  /// Owned and ghost rows of rays on any slice.
  const Range<int>& RaysReached() const { return this->Reached; }

  /// Number of nodes along the depth axis that the frustum reaches.
  int Depth() const { return static_cast<int>(this->Needed.front().size()); }

  /// Redistributes rays from their owners on slice `from` to their owners on slice `to`, with all
  /// `carried` values.
  void PassRays(int from, int to, const std::vector<RayValues>& carried) const;

  /// Exchanges ghost rows of `images` of the rays, for the voxels of slice `s` on other ranks.
  /// `cubic`: whether voxels read one more row on either side.
  void ExchangeRays(int s, bool cubic, const std::vector<float*>& images) const;

  /// Sends the owned rows of slice `s` to all ranks whose rays read them; nothing without fields.
  void ExchangeVoxels(int s, const std::vector<SliceWindow*>& fields) const;

private:
  /// Rows that are sent to a rank or received from it.
  struct RowMessage
  {
    int rank;
    Range<int> rows;
  };

  /// All messages for one slice.
  struct OnSlice
  {
    std::vector<RowMessage> sent;
    std::vector<RowMessage> received;
  };

  Range<int> RowsRead(const Range<int>& rays, int s) const;
  Range<int> RaysReadBy(int rank, int s, int more) const;
  void TakeAll();
  int NodesReached() const;
  void FindNeeded();
  void FindVisited();
  template <class Had, class Read>
  OnSlice Pass(const Had& had, const Read& read) const;
  template <class Add>
  void Exchange(const OnSlice& passing, const Add& add) const;

  FaceFrustum Frustum;
  const Communicator* All;
  int SlicesPerStretch;
  std::vector<std::vector<int>> Begins;        ///< first rows of the bands, see FindEvenBands
  std::vector<std::vector<Range<int>>> Needed; ///< [rank][node]
  Range<int> Reached;
  std::vector<Range<int>> Visited; ///< [row]: hull of the active columns over all slices
  std::vector<OnSlice> Rays[2];    ///< [cubic][slice]
  std::vector<OnSlice> Voxels;     ///< [slice]
};

/// Returns the nodes that a rank owns in the sweep of a frustum. No other rank changes them.
Region OwnedRegion(const FaceFrustum& frustum, const BandDecomposition& bands, int rank);

/// Returns the nodes that a rank owns or reads in the sweep of a frustum. `margin`: number of
/// columns and rows beside them that are added.
Region NeededRegion(
  const FaceFrustum& frustum, const BandDecomposition& bands, int rank, int margin = 0);

/// Returns the box of nodes with these columns and rows, and these nodes of the depth axis.
NodeBox BoxOf(const FaceFrustum& frustum, const Range<int>& columns, const Range<int>& rows,
  const Range<int>& nodes);
}

#endif
