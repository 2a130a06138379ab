// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_BrickDistances_h
#define limpid_render_BrickDistances_h

#include "render/Ray.h"

#include <cstdint>

namespace limpid
{
/// Where nothing is, see Bricks.
struct BrickDistances
{
  static constexpr int sizeBits = 2;
  static constexpr int size = 1 << sizeBits; ///< of a brick along each axis [cells]

  const std::uint8_t* distance = nullptr; ///< per brick; null: nothing is skipped
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

  /// Number of bricks that one can move along each axis, from one on, such that all on the way are
  /// empty; 0: it is not. Of one brick or of several. Numbers of 32 bits are enough for bricks of
  /// grids of 2^37 nodes.
  template <class Integer>
  LIMPID_HD LIMPID_INLINE Integer EmptyAround(const Integer* brick) const
  {
    return Gather(this->distance, brick[0] + (brick[1] + brick[2] * this->rows) * this->columns);
  }

  /// Number of the brick of a cell along an axis.
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

/// A way along a ray, or along several at once, past empty bricks.
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

  /// The first sample from `k` on whose segment is not known to be empty.
  LIMPID_HD LIMPID_INLINE Integer SkipEmpty(Integer k) const
  {
    Place place;
    place.Set(*this, k);
    auto moves = place.emptyAround > 0;
    while (AnyOf(moves))
    {
      // The last sample inside is empty as well as its segment, unless the next one is not.
      const Integer last = k + this->SamplesInside(place);
      place.Set(*this, last + 1);
      const auto empty = place.emptyAround > 0;
      k = Select(moves, Select(empty, last + 1, last), k);
      moves = And(moves, And(empty, k < this->Way.segments));
    }
    return AtMost(k, this->Way.segments);
  }

private:
  /// Where a sample is.
  struct Place
  {
    Number position[3]; ///< [index]
    Integer brick[3];
    Integer emptyAround; ///< bricks that one can move along each axis, all on the way empty

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

  /// Samples from a place on in the bricks from emptyAround - 1 before to emptyAround - 1 behind
  /// its own.
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
  Number PerPace[3]; ///< samples per cell; very many: it stays in the cell
};
}

#endif
