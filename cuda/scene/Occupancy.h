// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_Occupancy_h
#define limpid_scene_Occupancy_h

#include "backend/ResidentCopy.h"
#include "math/Range.h"
#include "scene/Grid.h"
#include "scene/NodeBox.h"

#include <memory>
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

  /// The spans of all rows along an axis, for kernels; valid as long as the memory they are in.
  /// Where every voxel counts as occupied, all rows share one entry.
  struct Rows
  {
    const Spans* spans;
    Index stride; ///< between rows with neighbouring indices along the last axis
    Index step;   ///< along the other axis

    LIMPID_HD LIMPID_INLINE const Spans& At(int first, int second) const
    {
      return this->spans[second * this->stride + first * this->step];
    }
  };

  /// The rows along grid axis `alongAxis` (0 or 1).
  Rows Along(int alongAxis) const
  {
    return { this->AllAlong(alongAxis).data(),
      this->Skip ? (alongAxis == 0 ? this->Nodes.y : this->Nodes.x) : 0, this->Skip ? 1 : 0 };
  }

  /// The memory of Along.
  const std::vector<Spans>& AllAlong(int alongAxis) const
  {
    return alongAxis == 0 ? this->AlongX : this->AlongY;
  }

  /// Returns the ranges of the row of voxels along grid axis `alongAxis` (0 or 1). `first` and
  /// `second` are its indices along the two other axes, lower axis first.
  const Spans& Row(int alongAxis, int first, int second) const
  {
    return this->Along(alongAxis).At(first, second);
  }

  /// What a GPU keeps of this occupancy and its copies.
  ResidentCopy& OnDevice() const { return *this->Resident; }

  bool Skips() const { return this->Skip; }
  Index FilledVoxels() const { return this->Filled; } ///< number of voxels that may change

private:
  friend class OccupancyBuilder;

  explicit Occupancy(const Grid& grid);

  void CountAll();

  Int3 Nodes;
  bool Skip = true;
  Index Filled = 0;
  std::vector<Spans> AlongX; ///< [z][y]; one entry if every voxel counts as occupied
  std::vector<Spans> AlongY; ///< [z][x]; likewise
  std::shared_ptr<ResidentCopy> Resident = std::make_shared<ResidentCopy>();
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
