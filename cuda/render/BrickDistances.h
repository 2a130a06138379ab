// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_BrickDistances_h
#define limpid_render_BrickDistances_h

#include "render/Ray.h"

#include <cmath>
#include <cstdint>

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

  /// Number of bricks that one can move along each axis, from that of the cell at or next to a
  /// position [index] on, such that all on the way are empty; 0: it is not.
  LIMPID_HD LIMPID_INLINE int EmptyAround(float x, float y, float z) const
  {
    const unsigned int brick[3] = { this->BrickAt(0, x), this->BrickAt(1, y), this->BrickAt(2, z) };
    return this->EmptyAround(brick);
  }

  LIMPID_HD LIMPID_INLINE int EmptyAround(const unsigned int* brick) const
  {
    const unsigned int row = brick[1] + unsigned(this->rows) * brick[2];
    return this->distance[brick[0] + std::uint64_t(row) * unsigned(this->columns)];
  }

  /// Number of a brick along an axis.
  LIMPID_HD LIMPID_INLINE unsigned int BrickAt(int axis, float position) const
  {
    const float limit = float(this->cells[axis] - 1);
    return static_cast<unsigned int>(Truncate(Clamp(position, 0.0f, limit))) / size;
  }
};

/// A way along a ray past empty bricks.
class BrickWalk
{
public:
  LIMPID_HD LIMPID_INLINE BrickWalk(const BrickDistances& bricks, const Ray& ray)
    : Bricks(bricks)
    , Way(ray)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const float pace = ray.step[axis];
      this->PerPace[axis] = std::abs(pace) > 1e-12f ? 1.0f / pace : 0.0f;
    }
  }

  /// The first sample from `k` on whose segment is not known to be empty.
  LIMPID_HD LIMPID_INLINE int SkipEmpty(int k) const
  {
    const int end = this->Way.segments;
    Place place(*this, k);
    while (place.emptyAround > 0)
    {
      // The last sample inside is empty as well as its segment, unless the next one is not.
      k += this->SamplesInside(place);
      if (k >= end)
      {
        return end;
      }
      place = Place(*this, k + 1);
      k += place.emptyAround > 0 ? 1 : 0;
      if (k >= end)
      {
        return end;
      }
    }
    return k;
  }

private:
  /// Where a sample is.
  struct Place
  {
    float position[3]; ///< [index]
    unsigned int brick[3];
    int emptyAround; ///< bricks that one can move along each axis, all on the way empty

    LIMPID_HD LIMPID_INLINE Place(const BrickWalk& walk, int k)
    {
      const BrickDistances& bricks = walk.Bricks;
      const float far = walk.Way.At(k);
      for (int axis = 0; axis < 3; ++axis)
      {
        this->position[axis] = walk.Way.entry[axis] + far * walk.Way.step[axis];
        this->brick[axis] = bricks.BrickAt(axis, this->position[axis]);
      }
      this->emptyAround = bricks.EmptyAround(this->brick);
    }
  };

  /// Samples from a place on in the bricks from emptyAround - 1 before to emptyAround - 1 behind
  /// its own.
  LIMPID_HD LIMPID_INLINE int SamplesInside(const Place& place) const
  {
    constexpr int size = BrickDistances::size;
    float steps = 1e6f;
    for (int axis = 0; axis < 3; ++axis)
    {
      const float perPace = this->PerPace[axis];
      const int brick = static_cast<int>(place.brick[axis]);
      const int side = perPace > 0.0f ? brick + place.emptyAround : brick - place.emptyAround + 1;
      const float reach = (float(side * size) - place.position[axis]) * perPace;
      steps = perPace != 0.0f && reach < steps ? reach : steps;
    }
    return steps > 0.0f ? static_cast<int>(steps) : 0;
  }

  const BrickDistances& Bricks;
  const Ray& Way;
  float PerPace[3]; ///< samples per cell; 0: it stays in the cell
};
}

#endif
