// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_SliceWindow_h
#define limpid_sweep_SliceWindow_h

#include "backend/Simd.h"
#include "scene/NodeValues.h"
#include "sweep/PlanSweep.h"
#include "sweep/SlabDelivery.h"

#include <memory>
#include <vector>

namespace limpid
{
class RankBands;

/**
 * Copied slices of a slab. Outside the columns that a row is known to have been written in, it is
 * 0, so that a field that is mostly empty is not filled with zeros again and again.
 */
struct SlabMemory
{
  /// Where a row may differ from 0.
  struct Written
  {
    Range<int> columns;
    int slices = 0;
  };

  NodeValues values; ///< [slice][row][column]
  std::vector<Written> rows;
};

/// Keeps the memory of slabs from one sweep of a frustum to the next.
class SlabPool
{
public:
  /// Memory for a slab that nobody else holds; it goes back when the last holder lets go. All calls
  /// are for the same frustum.
  std::shared_ptr<SlabMemory> Take(const FaceFrustum& frustum);

private:
  std::vector<std::shared_ptr<SlabMemory>> All;
};

/// What a sweep does with a field, and on which slices beside the one it has reached.
struct FieldUse
{
  int behind = 0; ///< slices behind that it reads, at most mostSlicesBehind
  bool writes = false;
  bool reads = true; ///< whether it reads what was there before the sweep
  int inFront = 0;   ///< slices in front that it reads, at most mostSlicesInFront
};

/**
 * A field seen slice by slice along the depth axis of a frustum, each row of voxels contiguous.
 *
 * Depth along y or z: rows of the field itself. Depth along x: a transposed copy of the slices of
 * a slab; Load and Store move it. Where ranks have the field elsewhere, along any axis: a copy that
 * SlabDelivery fills and returns.
 */
class SliceWindow
{
public:
  /// `field`: one value per node, null: there is none; written only by Store, or through Row where
  /// not transposed. `occupancy`: where it is not filled the field is known to be 0, and what is
  /// written there is lost; null: nothing is known. `pool` must outlive the window.
  SliceWindow(const FaceFrustum& frustum, const Occupancy* occupancy, SlabPool& pool, float* field,
    const FieldUse& use);
  SliceWindow(const FaceFrustum& frustum, const Occupancy* occupancy, SlabPool& pool,
    const float* field, const FieldUse& use)
    : SliceWindow(frustum, occupancy, pool, const_cast<float*>(field), use)
  {
  }

  /// From now on moves only what a rank needs: other rows are on other ranks. `delivery`: what
  /// moves it; null: Load and Store.
  void MoveNeeded(const RankBands& bands, const SlabDelivery* delivery)
  {
    this->Bands = &bands;
    this->Delivery = delivery;
    this->IsCopied = this->IsCopied || delivery;
  }

  /// Makes the slices of a slab readable, and those behind it that the sweep reads, too. What is
  /// delivered is 0.
  void Load(const Range<int>& slab);

  /// Writes the slices of the slab back, if the sweep writes.
  void Store(const Range<int>& slab);

  /// What is to be delivered of the slab that was loaded.
  SlabDelivery::Field Delivered() const;

  bool Reads() const { return this->Use.reads; }
  bool Writes() const { return this->Use.writes; }

  bool Empty() const { return this->Field == nullptr; }

  /// Whether the sweep reads what it has written.
  bool IsReadBehind() const { return !this->Empty() && this->Use.writes && this->Use.behind > 0; }
  int ColumnCount() const { return this->Columns; }

  /// Row `v` of the slice at a node: one value per column.
  float* Row(int node, int v)
  {
    return this->IsCopied ? this->Slices + (node - this->First) * this->Pitch + v * this->Columns
                          : this->Field + this->StrideW * node + this->StrideV * v;
  }

  /// Row `v` of the slice at a node will be read soon, or the last one.
  LIMPID_INLINE void Prefetch(int node, int v, const Range<int>& columns)
  {
    const float* row = this->Row(node, v < this->Rows ? v : this->Rows - 1);
    limpid::Prefetch(row + columns.begin, row + columns.end);
  }

private:
  std::vector<int> RowsOfRank(const Range<int>& rows, const Range<int>& nodes) const;
  Range<int> FilledIn(const Range<int>& nodes, int v, const Range<int>& columns) const;
  void ClearRow(int v, const Range<int>& kept, int slices);
  void TransposeRow(int v, const Range<int>& columns, const Range<int>& nodes);

  const FaceFrustum* Source;
  const Occupancy* Occupied;
  const RankBands* Bands = nullptr;
  const SlabDelivery* Delivery = nullptr;
  float* Field;
  FieldUse Use;
  bool IsCopied;
  int Columns;
  int Rows;
  Index Pitch; ///< of copied slices
  Index StrideV = 0;
  Index StrideW = 0;
  int First = 0;
  SlabPool* Pool;
  std::shared_ptr<SlabMemory> Memory; ///< of copied slices
  float* Slices = nullptr;
};
}

#endif
