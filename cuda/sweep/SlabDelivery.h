// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_SlabDelivery_h
#define limpid_sweep_SlabDelivery_h

#include "sweep/RankRegions.h"

#include <array>
#include <memory>
#include <vector>

namespace limpid
{
constexpr int slicesCopied = 16;     ///< floats in a cache line of 64 bytes
constexpr int mostSlicesBehind = 2;  ///< that sweeps read behind the slice they have reached
constexpr int mostSlicesInFront = 1; ///< ... in front of it

/// The slabs of a frustum, front to back: so many slices that a transposed read uses whole cache
/// lines. `copied`: whether slices are copied; else all are one slab.
std::vector<Range<int>> SlabsOf(const FaceFrustum& frustum, bool copied);

/// Node indices along the depth axis of some slices.
Range<int> NodesOf(const FaceFrustum& frustum, const Range<int>& slices);

/// All columns or rows that some slices have as `part`.
Range<int> HullOf(const FaceFrustum& frustum, const Range<int>& slices, Range<int> Slice::*part);

/// Where ranks have fields.
struct HomeOfFields
{
  Index first;                 ///< of node (0, 0, 0) in this rank's arrays; it need not be there
  std::array<Index, 3> stride; ///< see FieldView
  std::vector<Region> kept;    ///< of each rank the nodes that it has; no two have the same ones
  std::vector<Region> wanted;  ///< the nodes that it gets when they have changed

  /// In arrays of the nodes of a box.
  HomeOfFields(const NodeBox& box, std::vector<Region> had, std::vector<Region> returned);

  FieldView On(float* field) const { return { field + this->first, this->stride }; }
};

/**
 * What passes when ranks sweep a frustum of fields that they have elsewhere than beside its rays:
 * before a slab is swept, its slices come to where they are read; after it, what has changed goes
 * back. So of a field that a sweep visits a rank has a slab at a time.
 */
class SlabDelivery
{
public:
  /// `filled`: where else fields are 0; null: nowhere. It and the ranks have to stay. `margin`:
  /// columns and rows that are read beside those that rays are planned to read.
  SlabDelivery(const FaceFrustum& frustum, const RankBands& bands, const HomeOfFields& home,
    const Occupancy* filled, const std::shared_ptr<PassageRoom>& room, int margin);

  int Margin() const { return this->ReadBeside; }

  /// A field at home, and where slices of it are swept.
  struct Field
  {
    float* field;
    FieldView window;
  };

  /// Brings what is read of the slices of a slab, and of those beside it.
  void Bring(const Range<int>& slab, const std::vector<Field>& fields) const;

  /// Brings what was changed in the slices of a slab back.
  void Return(const Range<int>& slab, const std::vector<Field>& fields) const;

private:
  struct Ways
  {
    Range<int> slab;
    Passages there;
    Passages back;
  };

  const Ways& WaysOf(const Range<int>& slab) const;

  HomeOfFields Home;
  int ReadBeside;
  std::vector<Ways> All;
};
}

#endif
