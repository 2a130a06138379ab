// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_Occupancy_h
#define limpid_sweep_Occupancy_h

#include "math/Range.h"
#include "scene/Grid.h"
#include "scene/NodeBox.h"

#include <vector>

namespace limpid
{
class Communicator;

/**
 * For every row of voxels along x and along y: where the scene is not empty and where it is
 * important. What lies outside provably never changes (Documentation/Method.md, section on skips).
 */
class Occupancy
{
public:
  /// Both fields: grid.NodeCount() values; `importance` is that of nodes, see NodeImportance.h.
  /// With `skip` off every voxel counts as occupied.
  Occupancy(const Grid& grid, const float* baseExtinction, const float* importance, bool skip);

  /// That of a scene shared by ranks, of which each has the values of a box: the same on all of
  /// them. `box`: whose values the fields have; no other rank has any of these.
  Occupancy(const Communicator& ranks, const Grid& grid, const NodeBox& box,
    const float* baseExtinction, const float* importance, bool skip);

  struct Spans
  {
    Range<int> filled;    ///< base extinction or importance above zero
    Range<int> important; ///< importance above zero
  };

  /// The row of voxels along grid axis `alongAxis` (0 or 1); `first` and `second` are its indices
  /// along the two other axes, lower axis first.
  const Spans& Row(int alongAxis, int first, int second) const
  {
    return alongAxis == 0 ? this->AlongX[std::size_t(second) * this->Nodes.y + first]
                          : this->AlongY[std::size_t(second) * this->Nodes.x + first];
  }

  /// How far rows with neighbouring indices along the last axis lie apart.
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

/// Makes an Occupancy of voxels as they come.
class OccupancyBuilder
{
public:
  explicit OccupancyBuilder(const Grid& grid);

  /// Adds rows of a slice, which the two fields begin with. Slices may come in parallel, but the
  /// rows of one have to come in order.
  void Add(int slice, const Range<int>& rows, const float* extinction, const float* importance);

  /// When all rows have come. With `skip` off every voxel counts as occupied.
  Occupancy Take(bool skip);

private:
  Occupancy Made;
  std::vector<std::vector<int>> ColumnEnds; ///< of slices that are not complete
  std::vector<Index> Filled;                ///< per slice
};
}

#endif
