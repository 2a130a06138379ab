// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_SlabExchange_h
#define limpid_sweep_SlabExchange_h

#include "distributed/ExchangePlan.h"
#include "scene/FieldView.h"
#include "sweep/FaceFrustum.h"

#include <array>
#include <memory>
#include <vector>

namespace limpid
{
class BandDecomposition;

constexpr int slicesCopied = 16;     ///< floats in a cache line of 64 bytes
constexpr int mostSlicesBehind = 2;  ///< maximum number of slices behind that sweeps read
constexpr int mostSlicesInFront = 1; ///< maximum number of slices in front that sweeps read

/// Returns the slabs of a frustum, front to back. With `copied`, a slab has so many slices that a
/// transposed read uses whole cache lines; otherwise all slices are one slab.
std::vector<Range<int>> SlabsOf(const FaceFrustum& frustum, bool copied);

/// Returns the node indices of some slices along the depth axis.
Range<int> NodesOf(const FaceFrustum& frustum, const Range<int>& slices);

/// Returns the hull of the ranges `part` (columns or rows) of some slices.
Range<int> HullOf(const FaceFrustum& frustum, const Range<int>& slices, Range<int> Slice::*part);

/// The distribution of fields outside of sweeps.
struct FieldLayout
{
  Index first; ///< index of node (0, 0, 0) in this rank's arrays, which need not contain it
  std::array<Index, 3> stride; ///< see FieldView
  std::vector<Region> kept;    ///< [rank]: owned nodes; regions of ranks are disjoint
  std::vector<Region> wanted;  ///< [rank]: nodes to which changed values are returned

  /// For arrays that hold the nodes of a box.
  FieldLayout(const NodeBox& box, std::vector<Region> had, std::vector<Region> returned);

  FieldView On(float* field) const { return { field + this->first, this->stride }; }
};

/**
 * Redistributes fields for the sweep of a frustum whose decomposition differs from theirs. Before
 * a slab is swept, its slices are sent to the ranks that read them; afterwards changed values are
 * sent back. A rank therefore holds one slab at a time of each field of a sweep.
 */
class SlabExchange
{
public:
  /// `filled`: fields are 0 outside of it; null if nothing is known. It and the ranks must outlive
  /// this object. `margin`: extra columns and rows that are read beside those that the plan's rays
  /// read.
  SlabExchange(const FaceFrustum& frustum, const BandDecomposition& bands, const FieldLayout& home,
    const Occupancy* filled, const std::shared_ptr<ExchangeBuffers>& room, int margin);

  int Margin() const { return this->ReadBeside; }

  /// A field as it is distributed, and its slices in the sweep.
  struct Field
  {
    float* field;
    FieldView window;
  };

  /// Sends the slices that the sweep of a slab reads, including those next to the slab.
  void Bring(const Range<int>& slab, const std::vector<Field>& fields) const;

  /// Sends the changed slices of a slab back.
  void Return(const Range<int>& slab, const std::vector<Field>& fields) const;

private:
  struct Ways
  {
    Range<int> slab;
    ExchangePlan there;
    ExchangePlan back;
  };

  const Ways& WaysOf(const Range<int>& slab) const;

  FieldLayout Home;
  int ReadBeside;
  std::vector<Ways> All;
};
}

#endif
