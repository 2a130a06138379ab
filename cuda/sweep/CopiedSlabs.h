// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_CopiedSlabs_h
#define limpid_sweep_CopiedSlabs_h

#include "backend/Backend.h"
#include "scene/NodeValues.h"
#include "sweep/FieldSlabs.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace limpid
{
/// Copied slices of a slab. Each row records the columns that were written. All others are 0, so
/// that mostly empty fields are not cleared again and again.
struct SlabMemory
{
  /// Where a row may differ from 0.
  struct Written
  {
    Range<int> columns;
    int slices = 0;
  };

  explicit SlabMemory(const FaceFrustum& frustum);

  /// Clears what was written in a row, except `kept` on the first `slices` slices, which will be
  /// overwritten.
  void ClearRow(int v, const Range<int>& kept, int slices);

  int columns;
  Index pitch;       ///< distance between slices, padded so that rows use different cache sets
  NodeValues values; ///< [slice][row][column]
  std::vector<Written> rows;
};

/// Slices that are copied to memory of their own, which is kept between sweeps.
class CopiedSlabs : public FieldSlabs
{
public:
  SliceWindow Open(float* field, const FieldUse& use) override;

protected:
  /// Nodes in the axes of the frustum.
  struct Box
  {
    Range<int> columns;
    Range<int> rows;
    Range<int> nodes; ///< along the depth axis
  };

  /// `margin`: see FieldSlabs::Redistributed.
  CopiedSlabs(const FaceFrustum& frustum, const BandDecomposition& bands, int margin);

  /// Returns the nodes that the sweep of a slab reads, with so many slices in front and behind.
  Box BoxRead(
    const Range<int>& slab, int inFront = mostSlicesInFront, int behind = mostSlicesBehind) const
  {
    return this->HullOf({ std::max(slab.begin - inFront, 0),
                          std::min(slab.end + behind, this->Frustum.SliceCount()) },
      &Slice::touchedColumns, &Slice::touchedRows);
  }

  /// Returns the nodes of a slab that the frustum owns.
  Box BoxOwned(const Range<int>& slab) const
  {
    return this->HullOf(slab, &Slice::ownedColumns, &Slice::ownedRows);
  }

  /// From now on the copied slices of a window are those at `nodes`.
  static void Move(SliceWindow& window, const Range<int>& nodes)
  {
    window.values = window.memory->values.Data() - nodes.begin * window.strideW;
  }

  /// Calls what(v, columns) for the rows of a box that are needed here, in parallel, with the
  /// columns that are not known to be 0 on all slices.
  template <class What>
  void ForFilledRows(const Box& box, const Occupancy* occupancy, const What& what) const
  {
    const std::vector<int> rows = this->RowsNeeded(box);
    ParallelFor(static_cast<Index>(rows.size()),
      [&](Index row)
      {
        const int v = rows[std::size_t(row)];
        what(v, this->FilledIn(box, v, occupancy));
      });
  }

  FaceFrustum Frustum;

private:
  Box HullOf(const Range<int>& slices, Range<int> Slice::*columns, Range<int> Slice::*rows) const;
  std::vector<int> RowsNeeded(const Box& box) const;
  Range<int> FilledIn(const Box& box, int v, const Occupancy* occupancy) const;

  const BandDecomposition* Bands;
  int Margin;
  std::vector<std::shared_ptr<SlabMemory>> Memory; ///< free if it has no other holder
};
}

#endif
