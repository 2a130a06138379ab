// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What all rays of a picture share: numbers and addresses, nothing else.

#ifndef limpid_render_RayScene_h
#define limpid_render_RayScene_h

#include "render/Classification.h"
#include "render/RayLight.h"
#include "render/Trilinear.h"

#include <cmath>

namespace limpid
{
/// Where nothing is, see Bricks.
struct BrickDistances
{
  static constexpr int size = 4; ///< of a brick along each axis [cells]

  const std::uint8_t* distance = nullptr; ///< per brick; null: nothing is skipped
  int cells[3] = { 0, 0, 0 };
  int columns = 0; ///< bricks along x
  int rows = 0;    ///< ... along y

  /// Of the bricks of a grid with so many nodes.
  static BrickDistances Of(const Int3& nodes, const std::uint8_t* distance)
  {
    BrickDistances bricks;
    bricks.distance = distance;
    for (int axis = 0; axis < 3; ++axis)
    {
      bricks.cells[axis] = nodes[axis] - 1;
    }
    bricks.columns = (nodes.x + size - 2) / size;
    bricks.rows = (nodes.y + size - 2) / size;
    return bricks;
  }

  /// Number of bricks that one can move along each axis, from a cell on, such that all on the way
  /// are empty; 0: the brick of this cell is not.
  LIMPID_HD LIMPID_INLINE int EmptyAround(const int* cell) const
  {
    return this->distance[cell[0] / size +
      this->columns * (cell[1] / size + Index(this->rows) * (cell[2] / size))];
  }

  /// The same at sample `k` of a ray, and where that is [index].
  LIMPID_HD LIMPID_INLINE int EmptyAround(const Ray& ray, int k, float* position) const
  {
    const float far = ray.At(k);
    int cell[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      position[axis] = ray.entry[axis] + far * ray.step[axis];
      const int at = static_cast<int>(position[axis] > 0.0f ? position[axis] : 0.0f);
      cell[axis] = at < this->cells[axis] ? at : this->cells[axis] - 1;
    }
    return this->EmptyAround(cell);
  }

  /// The first sample from `k` on whose segment is not known to be empty.
  LIMPID_HD LIMPID_INLINE int SkipEmpty(const Ray& ray, int k) const
  {
    while (k < ray.segments)
    {
      float position[3];
      const int around = this->EmptyAround(ray, k, position);
      if (around == 0)
      {
        return k;
      }
      // The last sample inside is empty as well as its segment, unless the next one is not.
      const float steps = StepsInside(ray, position, around);
      const int inside = steps < 1e6f ? static_cast<int>(steps) : 1000000;
      k += inside > 0 ? inside : 0;
      if (k + 1 >= ray.segments)
      {
        // The last segment: its far end is at the exit, in this or a neighbouring brick.
        float last[3];
        return k < ray.segments && this->EmptyAround(ray, k + 1, last) == 0 ? k : ray.segments;
      }
      float next[3];
      if (this->EmptyAround(ray, k + 1, next) == 0)
      {
        return k;
      }
      ++k;
    }
    return ray.segments;
  }

private:
  /// Samples from a position on in the bricks from around - 1 before to around - 1 behind its own.
  LIMPID_HD static LIMPID_INLINE float StepsInside(
    const Ray& ray, const float* position, int around)
  {
    float steps = 3.4e38f;
    for (int axis = 0; axis < 3; ++axis)
    {
      const float pace = ray.step[axis];
      const int brick = static_cast<int>(position[axis] > 0.0f ? position[axis] : 0.0f) / size;
      const int side = pace > 0.0f ? brick + around : brick - around + 1;
      const float way = float(side * size) - position[axis];
      const float reach = way / pace;
      steps = std::abs(pace) > 1e-12f && reach < steps ? reach : steps;
    }
    return steps;
  }
};

struct RayScene
{
  CellGrid grid;
  const float* scalars = nullptr;
  const float* filled = nullptr; ///< see ScalarField; null: all nodes are
  OpticalTable<FourFloats> table;
  const FourPacked* gradient = nullptr; ///< see PackedGradientNode; null: not lit
  const float* importance = nullptr;    ///< at the nodes of the scalars [0, 1]; null: not asked for
  CellGrid overlayGrid;
  const FourPacked* overlay = nullptr; ///< see ExtinctionOverlay; null: nothing to add
  BrickDistances bricks;
  BrickDistances unimportant;          ///< if the importance is asked for
  float overlayScale[3] = { 1, 1, 1 }; ///< nodes of the overlay per node of the scalars
  float opaqueBelow = 0;
  float stepLength = 1; ///< between samples [length]
  float majorant = 0;   ///< of the transfer function [1/length]
  float addedUnit = 1;  ///< of what the overlay adds [majorant]
  RayLight light;

  /// For nodes of overlay and scalars over the same box.
  void PlaceOverlay(const Int3& nodes, const Int3& scalarNodes)
  {
    this->overlayGrid = CellGrid(nodes);
    for (int axis = 0; axis < 3; ++axis)
    {
      const int cells = scalarNodes[axis] > 1 ? scalarNodes[axis] - 1 : 1;
      this->overlayScale[axis] = float(nodes[axis] - 1) / float(cells);
    }
  }
};
}

#endif
