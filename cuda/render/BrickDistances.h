// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_BrickDistances_h
#define limpid_render_BrickDistances_h

#include "render/Ray.h"

#include <cstdint>

namespace limpid
{
/// The distances from bricks to non-empty ones, see Bricks.
struct BrickDistances
{
  static constexpr int sizeBits = 2;
  static constexpr int size = 1 << sizeBits; ///< edge length of a brick [cells]

  const std::uint8_t* distance = nullptr; ///< one per brick; null: nothing is skipped
  int cells[3] = { 0, 0, 0 };
  int columns = 0; ///< bricks along x
  int rows = 0;    ///< bricks along y

  /// Returns the bricks of a grid with these numbers of nodes. `distance`: as above.
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

  /// Returns the number of bricks that a ray can advance along each axis, counting this one, so
  /// that all on the way are empty; 0: this brick is not empty. For one brick or several. 32 bits
  /// suffice for bricks of grids of 2^37 nodes.
  template <class Integer>
  LIMPID_HD LIMPID_INLINE Integer EmptyAround(const Integer* brick) const
  {
    return Gather(this->distance, brick[0] + (brick[1] + brick[2] * this->rows) * this->columns);
  }

  /// Returns the index of the brick of a cell along an axis.
  template <class Integer>
  LIMPID_HD LIMPID_INLINE static Integer BrickOf(const Integer& cell)
  {
    return cell >> sizeBits;
  }

  /// Returns the brick of the cell at or next to a position [index].
  template <class Number>
  LIMPID_HD LIMPID_INLINE auto BrickAt(int axis, const Number& position) const
  {
    return BrickOf(Truncate(Clamp(position, 0.0f, float(this->cells[axis] - 1))));
  }
};

/// Moves along one ray, or along several at once, and skips empty bricks.
template <class AnyRay>
class BrickWalk
{
public:
  using Number = typename AnyRay::Number;
  using Integer = typename AnyRay::Integer;

  LIMPID_HD LIMPID_INLINE BrickWalk(const BrickDistances& bricks, const AnyRay& ray)
    : Bricks(bricks)
    , Way(ray)
  {
    constexpr float never = 1e30f;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Number pace = ray.step[axis];
      this->PerPace[axis] = Select(Magnitude(pace) > 1e-12f, 1.0f / pace, never);
    }
  }

  /// Returns the first sample from `k` on whose segment is not known to be empty.
  LIMPID_HD LIMPID_INLINE Integer SkipEmpty(Integer k) const
  {
    Place place;
    place.Set(*this, k);
    auto moves = place.emptyAround > 0;
    while (AnyOf(moves))
    {
      // The last sample inside is also empty, as is its segment, unless the next sample is not.
      const Integer last = k + this->SamplesInside(place);
      place.Set(*this, last + 1);
      const auto empty = place.emptyAround > 0;
      k = Select(moves, Select(empty, last + 1, last), k);
      moves = And(moves, And(empty, k < this->Way.segments));
    }
    return AtMost(k, this->Way.segments);
  }

private:
  /// The place of a sample.
  struct Place
  {
    Number position[3]; ///< [index]
    Integer brick[3];
    Integer emptyAround; ///< number of bricks to advance along each axis such that all are empty

    LIMPID_HD LIMPID_INLINE void Set(const BrickWalk& walk, const Integer& k)
    {
      const Number far = DistanceOf(walk.Way, ToFloat(k));
      for (int axis = 0; axis < 3; ++axis)
      {
        this->position[axis] = walk.Way.entry[axis] + far * walk.Way.step[axis];
        this->brick[axis] = walk.Bricks.BrickAt(axis, this->position[axis]);
      }
      this->emptyAround = walk.Bricks.EmptyAround(this->brick);
    }
  };

  /// Returns the number of samples, from a place on, within emptyAround - 1 bricks on either side
  /// of its own.
  LIMPID_HD LIMPID_INLINE Integer SamplesInside(const Place& place) const
  {
    Number steps = 1e6f;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Integer front = place.brick[axis] + place.emptyAround;
      const Integer rear = place.brick[axis] - place.emptyAround + 1;
      const Integer side = Select(this->PerPace[axis] > 0.0f, front, rear);
      const Number reach =
        (ToFloat(side * BrickDistances::size) - place.position[axis]) * this->PerPace[axis];
      steps = AtMost(reach, steps);
    }
    return Truncate(AtLeast(steps, 0.0f));
  }

  const BrickDistances& Bricks;
  const AnyRay& Way;
  Number PerPace[3]; ///< samples per cell; very large if the ray stays in the cell
};
}

#endif
