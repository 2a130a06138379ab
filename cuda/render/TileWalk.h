// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_TileWalk_h
#define limpid_render_TileWalk_h

#include "render/BrickDistances.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
/**
 * A way past empty bricks for all rays of a tile of pixels together: the planes of equal depth move
 * along the ray in the tile's middle as long as the bricks around it are empty so far that no other
 * ray of the tile can have met anything.
 */
class TileWalk
{
public:
  /// The tile has the pixels from (left, bottom) to (right - 1, top - 1).
  TileWalk(
    const RayMaker& maker, const BrickDistances& bricks, int left, int bottom, int right, int top)
  {
    const double columns[2] = { double(left), right - 1.0 };
    const double rows[2] = { double(bottom), top - 1.0 };
    const Line middle(maker, 0.5 * (columns[0] + columns[1]), 0.5 * (rows[0] + rows[1]));
    this->Normal = maker.DepthNormal();
    if (glm::dot(this->Normal, middle.way) < 0)
    {
      this->Normal = -this->Normal;
    }
    const Vec3 last(bricks.cells[0], bricks.cells[1], bricks.cells[2]);
    const Vec3 farthest = this->Normal * last;
    const double first = glm::dot(glm::min(farthest, Vec3(0.0)), Vec3(1.0));
    const double end = glm::dot(glm::max(farthest, Vec3(0.0)), Vec3(1.0));
    const Vec3 in = middle.At(this->Normal, first);
    const Vec3 out = middle.At(this->Normal, end);
    double aside = 0; // how far any ray is from that in the middle [cells]
    for (int corner = 0; corner < 4; ++corner)
    {
      const Line line(maker, columns[corner & 1], rows[corner >> 1]);
      aside = std::max({ aside, Largest(line.At(this->Normal, first) - in),
        Largest(line.At(this->Normal, end) - out) });
    }
    const double share = ShareEmpty(bricks, in, out - in, aside);
    this->Nothing = share >= 1;
    this->Depth = first + share * (end - first);
  }

  /// Whether no ray meets anything.
  bool IsEmpty() const { return this->Nothing; }

  /// A sample of a ray of the tile before which all segments are empty.
  int FirstSample(const Ray& ray) const
  {
    const Vec3 entry(ray.entry[0], ray.entry[1], ray.entry[2]);
    const Vec3 step(ray.step[0], ray.step[1], ray.step[2]);
    const double distance =
      (this->Depth - glm::dot(this->Normal, entry)) / glm::dot(this->Normal, step);
    const double sample = std::floor(distance + double(ray.shift)) - 1;
    return sample > 0 ? static_cast<int>(std::min(sample, double(ray.segments))) : 0;
  }

private:
  struct Line
  {
    Vec3 from;
    Vec3 way;

    Line(const RayMaker& maker, double column, double row)
      : from(maker.PointOf(column, row, -1))
      , way(maker.PointOf(column, row, 1) - from)
    {
    }

    /// Where it meets a plane.
    Vec3 At(const Vec3& normal, double depth) const
    {
      return this->from +
        (depth - glm::dot(normal, this->from)) / glm::dot(normal, this->way) * way;
    }
  };

  static double Largest(const Vec3& way)
  {
    return std::max({ std::abs(way.x), std::abs(way.y), std::abs(way.z) });
  }

  /// The share of a way on which nothing lies closer than `aside` [cells]; less where that takes
  /// too many steps, as on ways that are not finite.
  static double ShareEmpty(
    const BrickDistances& bricks, const Vec3& from, const Vec3& way, double aside)
  {
    constexpr double least = 0.5; // cells that it must gain at a time
    constexpr int most = 1000;    // steps
    const double cells = Largest(way);
    double share = 0;
    for (int step = 0; step < most && share < 1; ++step)
    {
      const Vec3 at = from + share * way;
      const int around = bricks.EmptyAround(float(at.x), float(at.y), float(at.z));
      const double room = BrickDistances::size * (around - 1) - aside - 0.01; // less than rounding
      if (!(room >= least))
      {
        break;
      }
      share += room / cells;
    }
    return share;
  }

  Vec3 Normal; ///< of planes of equal depth
  double Depth = 0;
  bool Nothing = false;
};
}

#endif
