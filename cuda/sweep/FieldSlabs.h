// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_FieldSlabs_h
#define limpid_sweep_FieldSlabs_h

#include "distributed/ExchangePlan.h"
#include "scene/FieldView.h"
#include "sweep/FaceFrustum.h"
#include "sweep/SliceWindow.h"

#include <array>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

namespace limpid
{
class BandDecomposition;
class MadeFields;

constexpr int mostSlicesBehind = 2;  ///< maximum number of slices behind that sweeps read
constexpr int mostSlicesInFront = 1; ///< maximum number of slices in front that sweeps read

/// The distribution of fields outside of sweeps.
struct FieldLayout
{
  const Communicator* ranks; ///< those that share the fields
  Index first; ///< index of node (0, 0, 0) in the local arrays, which need not contain it
  std::array<Index, 3> stride; ///< see FieldView
  std::vector<Region> kept;    ///< [rank]: owned nodes; regions of ranks are disjoint
  std::vector<Region> wanted;  ///< [rank]: nodes to which changed values are returned

  std::shared_ptr<ExchangeBuffers> room = std::make_shared<ExchangeBuffers>(); ///< for all sweeps

  /// For arrays that hold the nodes of a box. `among` must outlive this object.
  FieldLayout(const Communicator& among, const NodeBox& box, std::vector<Region> had,
    std::vector<Region> returned);

  FieldView On(float* field) const { return { field + this->first, this->stride }; }
};

/// How the sweeps of a frustum get the slices of fields: in place, transposed, or redistributed.
/// The slices of a slab are loaded together before it is swept, and stored afterwards.
class FieldSlabs
{
public:
  using Windows = std::deque<SliceWindow>; ///< the fields of a sweep

  /// For fields that hold the nodes which the rank reads. Rows of voxels along x are accessed in
  /// place. If the depth is along x, slices are copied with the rows along y. `bands` must outlive
  /// the result.
  static std::unique_ptr<FieldSlabs> Local(
    const FaceFrustum& frustum, const BandDecomposition& bands);

  /**
   * For fields whose decomposition differs from that of the frustum. Before a slab is swept, its
   * slices are sent to the ranks that read them; afterwards changed values are sent back. A rank
   * therefore holds one slab at a time of each field of a sweep.
   *
   * `filled`: fields are 0 outside of it; null if nothing is known. It and `bands` must outlive
   * the result. `margin`: extra columns and rows that are read beside those that the plan's rays
   * read.
   */
  static std::unique_ptr<FieldSlabs> Redistributed(const FaceFrustum& frustum,
    const BandDecomposition& bands, const FieldLayout& home, const Occupancy* filled, int margin);

  /// Like Local, but some fields are made for each slab. `made` must outlive the result. A process
  /// alone only.
  static std::unique_ptr<FieldSlabs> Made(
    const FaceFrustum& frustum, const BandDecomposition& bands, MadeFields& made);

  virtual ~FieldSlabs() = default;

  /// Ranges of slices that are loaded together, front to back.
  const std::vector<Range<int>>& Slabs() const { return this->All; }

  /// Returns the window of a field. Its rows may be used between Load and Store. Only Store writes
  /// the field, or Row in place.
  virtual SliceWindow Open(float* field, const FieldUse& use) = 0;

  /// Makes the slices of a slab readable, and those beside it that the sweep reads. `occupancy`:
  /// outside of it fields are known to be 0 and writes are lost; null if nothing is known.
  virtual void Load(const Range<int>& slab, const Occupancy* occupancy, Windows& windows) const = 0;

  /// Writes the slices of a slab back to the fields that the sweep changes.
  virtual void Store(
    const Range<int>& slab, const Occupancy* occupancy, const Windows& windows) const = 0;

protected:
  explicit FieldSlabs(std::vector<Range<int>> slabs)
    : All(std::move(slabs))
  {
  }

private:
  std::vector<Range<int>> All;
};
}

#endif
