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

/// Rows of rays or voxels that are visited here: all in a range, or those of a list.
struct RowsHere
{
  Range<int> range;
  const std::vector<int>* list = nullptr; ///< null: the range

  int Length() const
  {
    return this->list ? static_cast<int>(this->list->size()) : this->range.Length();
  }

  int operator[](Index i) const
  {
    return this->list ? (*this->list)[std::size_t(i)] : this->range.begin + static_cast<int>(i);
  }
};

/**
 * A frustum shared by ranks, which have bands of consecutive rows of rays, and of the voxels of
 * each slice those beside their rays. The arithmetic of a row is that of one process, so that
 * results are the same bit by bit; what rows of neighbours read of each other travels slice by
 * slice (Documentation/Method.md, section on ranks).
 *
 * Bands have about the same number of samples that matter and of voxels that may change. Ranks wait
 * for each other on every slice, and what matters lies elsewhere on each: so a rank has several
 * bands, every so-manieth.
 */
class RankBands
{
public:
  /// The frustum's tables and the ranks have to stay. Voxels have to be planned, too.
  RankBands(const FaceFrustum& frustum, const Communicator& ranks);

  const Communicator& Ranks() const { return *this->All; }

  /// Rows of rays of this rank.
  RowsHere RaysHere() const { return { {}, &this->OwnRays }; }

  /// Rows of voxels of slice `s` that this rank changes, of those that the frustum owns.
  RowsHere VoxelsHere(int s) const { return { {}, &this->OwnVoxels[std::size_t(s)] }; }

  int BandCount() const { return static_cast<int>(this->Begins.size()) - 1; }
  int RankOf(int band) const { return band % this->All->Size(); }

  /// The bands of a rank.
  std::vector<int> BandsOf(int rank) const;

  /// Rows of rays of a band.
  Range<int> RaysOf(int band) const
  {
    return { this->Begins[std::size_t(band)], this->Begins[std::size_t(band) + 1] };
  }

  /// Rows of voxels of slice `s` that are changed with a band.
  Range<int> VoxelsOf(int band, int s) const;

  /// Rows of voxels at a node of the depth axis that the rays of a band read, or that are changed
  /// with it; empty: none.
  Range<int> VoxelsNeeded(int band, int node) const
  {
    return this->Needed[std::size_t(band)][std::size_t(node)];
  }

  /// Nodes along the depth axis, as far as the frustum goes.
  int Depth() const { return static_cast<int>(this->Needed.front().size()); }

  /// Brings images of the rays, one value per ray, to all ranks whose voxels of slice `s` read
  /// them. `cubic`: whether voxels read a row more on either side.
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
  Range<int> RaysReadBy(int band, int s, int more) const;
  void FindNeeded();
  void FindOwn();
  template <class Had, class Read>
  OnSlice Pass(const Had& had, const Read& read) const;
  template <class Add>
  void Exchange(const OnSlice& passing, const Add& add) const;

  FaceFrustum Frustum;
  const Communicator* All;
  std::vector<int> Begins;                     ///< of the bands' rows, and behind the last one
  std::vector<std::vector<Range<int>>> Needed; ///< [band][node]
  std::vector<int> OwnRays;
  std::vector<std::vector<int>> OwnVoxels; ///< [slice]
  std::vector<OnSlice> Rays[2];            ///< [cubic][slice]
  std::vector<OnSlice> Voxels;             ///< [slice]
};
}

#endif
