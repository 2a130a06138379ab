// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_Occupancy_h
#define limpid_scene_Occupancy_h

#include "math/Range.h"
#include "scene/Grid.h"
#include "scene/NodeBox.h"

#include <vector>

namespace limpid
{
/**
 * For every row of voxels along x and along y: the ranges where the scene is not empty and where
 * it is important. Voxels outside these ranges provably never change (Documentation/Method.md,
 * section on skips).
 */
class Occupancy
{
public:
  struct Spans
  {
    Range<int> filled;    ///< base extinction or importance above zero
    Range<int> important; ///< importance above zero
  };

  /// Both fields have grid.NodeCount() values; `importance` is that of the nodes, see
  /// NodeImportance.h. If `skip` is false, every voxel counts as occupied.
  Occupancy(const Grid& grid, const float* baseExtinction, const float* importance, bool skip);

  /// Assembles an occupancy from the spans of all rows along x, [z][y], and along y, [z][x].
  /// `filled`: number of voxels that may change. If `skip` is false, every voxel counts as
  /// occupied.
  Occupancy(const Grid& grid, std::vector<Spans> alongX, std::vector<Spans> alongY, Index filled,
    bool skip);

  /// Returns the ranges of the row of voxels along grid axis `alongAxis` (0 or 1). `first` and
  /// `second` are its indices along the two other axes, lower axis first.
  const Spans& Row(int alongAxis, int first, int second) const
  {
    return alongAxis == 0 ? this->AlongX[std::size_t(second) * this->Nodes.y + first]
                          : this->AlongY[std::size_t(second) * this->Nodes.x + first];
  }

  /// Distance in memory between rows with neighbouring indices along the last axis.
  Index RowStride(int alongAxis) const { return alongAxis == 0 ? this->Nodes.y : this->Nodes.x; }

  bool Skips() const { return this->Skip; }
  Index FilledVoxels() const { return this->Filled; } ///< number of voxels that may change

private:
  friend class OccupancyBuilder;

  explicit Occupancy(const Grid& grid);

  void CountAll();

  Int3 Nodes;
  bool Skip = true;
  Index Filled = 0;
  std::vector<Spans> AlongX; ///< [z][y]
  std::vector<Spans> AlongY; ///< [z][x]
};

/// Builds an Occupancy from voxels that arrive slice by slice.
class OccupancyBuilder
{
public:
  explicit OccupancyBuilder(const Grid& grid);

  /// Adds rows of a slice; both fields start at the first of these rows. Slices may be added
  /// concurrently, but the rows of one slice must be added in order.
  void Add(int slice, const Range<int>& rows, const float* extinction, const float* importance);

  /// Returns the result after all rows were added. If `skip` is false, every voxel counts as
  /// occupied.
  Occupancy Take(bool skip);

private:
  Occupancy Made;
  std::vector<std::vector<int>> ColumnEnds; ///< for slices that are not complete yet
  std::vector<Index> Filled;                ///< per slice
};
}

#endif
