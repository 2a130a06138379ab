// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_SliceWindow_h
#define limpid_sweep_SliceWindow_h

#include "backend/Simd.h"
#include "scene/NodeValues.h"
#include "sweep/PlanSweep.h"
#include "sweep/SlabExchange.h"

#include <memory>
#include <vector>

namespace limpid
{
class BandDecomposition;

/**
 * Copied slices of a slab. Each row records the columns that were written. All others are 0, so
 * that mostly empty fields are not cleared again and again.
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

/// Keeps the memory of slabs between sweeps of a frustum.
class SlabPool
{
public:
  /// Returns unused memory for a slab. It is reused once its last holder has released it. All
  /// calls must be for the same frustum.
  std::shared_ptr<SlabMemory> Take(const FaceFrustum& frustum);

private:
  std::vector<std::shared_ptr<SlabMemory>> All;
};

/// How a sweep uses a field, and on which slices besides the current one.
struct FieldUse
{
  int behind = 0; ///< number of slices behind that it reads, at most mostSlicesBehind
  bool writes = false;
  bool reads = true; ///< whether it reads values from before the sweep
  int inFront = 0;   ///< number of slices in front that it reads, at most mostSlicesInFront
};

/**
 * Access to a field slice by slice along the depth axis of a frustum, with contiguous rows of
 * voxels.
 *
 * Depth along y or z: rows of the field itself. Depth along x: a transposed copy of the slices of
 * a slab, which Load and Store transfer. If the field is distributed differently: a copy along any
 * axis, which SlabExchange fills and returns.
 */
class SliceWindow
{
public:
  /// `field`: one value per node, or null. Only Store writes it, or Row if it is not copied.
  /// Only the rows that this rank needs are transferred. `delivery`: transfers them; if null, Load
  /// and Store do. `occupancy`: outside of it the field is known to be 0 and writes are lost; null
  /// if nothing is known. `bands`, `delivery` and `pool` must outlive the window.
  SliceWindow(const FaceFrustum& frustum, const BandDecomposition& bands,
    const SlabExchange* delivery, const Occupancy* occupancy, SlabPool& pool, float* field,
    const FieldUse& use);
  SliceWindow(const FaceFrustum& frustum, const BandDecomposition& bands,
    const SlabExchange* delivery, const Occupancy* occupancy, SlabPool& pool, const float* field,
    const FieldUse& use)
    : SliceWindow(frustum, bands, delivery, occupancy, pool, const_cast<float*>(field), use)
  {
  }

  /// Makes the slices of a slab readable, and those behind it that the sweep reads. Slices that
  /// `delivery` will fill are set to 0.
  void Load(const Range<int>& slab);

  /// Writes the slices of the slab back if the sweep changes the field.
  void Store(const Range<int>& slab);

  /// Returns what `delivery` has to transfer for the loaded slab.
  SlabExchange::Field Delivered() const;

  bool Reads() const { return this->Use.reads; }
  bool Writes() const { return this->Use.writes; }

  bool Empty() const { return this->Field == nullptr; }

  /// Whether the sweep reads values that it has written.
  bool IsReadBehind() const { return !this->Empty() && this->Use.writes && this->Use.behind > 0; }
  int ColumnCount() const { return this->Columns; }

  /// Returns row `v` of the slice at a node: one value per column.
  float* Row(int node, int v)
  {
    return this->IsCopied ? this->Slices + (node - this->First) * this->Pitch + v * this->Columns
                          : this->Field + this->StrideW * node + this->StrideV * v;
  }

  /// Prefetches row `v` of the slice at a node, or the last row.
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
  const BandDecomposition* Bands;
  const SlabExchange* Delivery;
  const Occupancy* Occupied;
  float* Field;
  FieldUse Use;
  bool IsCopied;
  int Columns;
  int Rows;
  Index Pitch; ///< distance between copied slices
  Index StrideV = 0;
  Index StrideW = 0;
  int First = 0;
  SlabPool* Pool;
  std::shared_ptr<SlabMemory> Memory; ///< of copied slices
  float* Slices = nullptr;
};
}

#endif
