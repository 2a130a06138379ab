// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The bricks of a volume on a device: Bricks.cxx, brick by brick.

#ifndef limpid_render_BrickBodies_h
#define limpid_render_BrickBodies_h

#include "render/BrickNodes.h"
#include "render/OverlayKernels.h"

namespace limpid
{
/// Range of the scalars at the nodes of a brick.
struct RangeOfBrick
{
  NodeCounts nodes;
  NodeCounts bricks;
  const float* scalars;
  ScalarRange* ranges; ///< out

  LIMPID_HD void operator()(Index brick) const
  {
    const BrickNodes box = BrickNodes::Of(this->bricks.ColumnOf(brick), this->bricks.RowOf(brick),
      this->bricks.SliceOf(brick), this->nodes.x, this->nodes.y, this->nodes.z);
    ScalarRange range;
    box.ForEach(
      this->nodes.x, this->nodes.y, [&](Index node) { range.Include(this->scalars[node]); });
    this->ranges[brick] = range;
  }
};

/// 0 where a brick may have extinction, else the largest distance.
struct EmptyBrick
{
  NodeCounts nodes;
  NodeCounts bricks;
  OpticalTable<FourFloats> table;
  const ScalarRange* ranges;
  const std::int16_t* overlay; ///< see OverlayField; null: unchanged
  NodeCounts overlayNodes;
  std::uint8_t* distance; ///< out

  LIMPID_HD void operator()(Index brick) const
  {
    const ScalarRange range = this->ranges[brick];
    float largest = this->table.LargestBetween(
      this->table.Position(range.least), this->table.Position(range.most));
    if (this->overlay)
    {
      const BrickNodes box = BrickNodes::Of(this->bricks.ColumnOf(brick), this->bricks.RowOf(brick),
        this->bricks.SliceOf(brick), this->nodes.x, this->nodes.y, this->nodes.z)
                               .On(this->nodes.x, this->overlayNodes.x, 0)
                               .On(this->nodes.y, this->overlayNodes.y, 1)
                               .On(this->nodes.z, this->overlayNodes.z, 2);
      LargestChange most;
      box.ForEach(this->overlayNodes.x, this->overlayNodes.y,
        [&](Index node) { most.Include(this->overlay + 4 * node); });
      largest = most.Of(largest);
    }
    this->distance[brick] = largest > 0 ? 0 : farthestBrick;
  }
};

/// One axis of the Chebyshev distance to the nearest zero: the largest of the distances along the
/// axes is that of the axes before or of this one, whichever is larger.
struct SpreadBrick
{
  NodeCounts bricks;
  int axis;
  const std::uint8_t* before; ///< along the axes before
  std::uint8_t* distance;     ///< out

  LIMPID_HD void operator()(Index brick) const
  {
    const int at = this->axis == 0
      ? this->bricks.ColumnOf(brick)
      : (this->axis == 1 ? this->bricks.RowOf(brick) : this->bricks.SliceOf(brick));
    const int count =
      this->axis == 0 ? this->bricks.x : (this->axis == 1 ? this->bricks.y : this->bricks.z);
    const Index stride = this->axis == 0
      ? 1
      : (this->axis == 1 ? Index(this->bricks.x) : Index(this->bricks.x) * this->bricks.y);
    int least = this->before[brick];
    for (int way = 1; way < least; ++way)
    {
      for (int side = -1; side <= 1; side += 2)
      {
        const int other = at + side * way;
        if (other >= 0 && other < count)
        {
          const int there = this->before[brick + side * way * stride];
          const int reached = there > way ? there : way;
          least = reached < least ? reached : least;
        }
      }
    }
    this->distance[brick] = static_cast<std::uint8_t>(least);
  }
};
}

#endif
