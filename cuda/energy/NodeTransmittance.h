// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The transmittance of single nodes, each computed along its own ray.

#ifndef limpid_energy_NodeTransmittance_h
#define limpid_energy_NodeTransmittance_h

#include "math/Number.h"
#include "math/Vec.h"
#include "scene/Grid.h"
#include "scene/RaySource.h"
#include "sweep/HalfLayer.h"

#include <cmath>
#include <cstdint>

namespace limpid
{
/// Whether the transmittance of neighbouring nodes, from `least` to `most`, varies so much that it
/// may jump between the rays of a sweep: by 0.1 where it is bright, by less where light shines
/// through gaps. With this limit the error at opaque blocks, shells, sheets and waves is within
/// 1e-3 rms of a march (TransmittanceAtNodes tests).
LIMPID_HD LIMPID_INLINE bool IsSteep(float least, float most)
{
  return (most - least) * (most - least) > 0.01f * most;
}

/// An optical depth as an integer, so that sums do not depend on their order.
using WholeDepth = std::int64_t;
constexpr double unitsOfDepth = 1LL << 40;

/// At an optical depth of 24, transmittance is negligible compared to 1 in single precision.
constexpr WholeDepth darkWholeDepth = 24 * (1LL << 40);

/// Returns exp(-depth), or 0 beyond darkWholeDepth.
LIMPID_HD inline float TransmittanceOf(WholeDepth depth)
{
  return depth >= darkWholeDepth
    ? 0.0f
    : static_cast<float>(std::exp(-static_cast<double>(depth) / unitsOfDepth));
}

/// A box of nodes of a grid, for kernels: `begin` is the first node and `end` one past the last
/// along each axis.
struct NodesWithin
{
  Int3 begin;
  Int3 end;

  static NodesWithin Whole(const Grid& grid) { return { Int3(0), grid.nodes }; }

  /// The first nodes of all cells.
  static NodesWithin CellsOf(const Grid& grid) { return { Int3(0), grid.nodes - 1 }; }

  LIMPID_HD bool Contains(const Int3& node) const
  {
    bool contains = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      contains = contains && node[axis] >= this->begin[axis] && node[axis] < this->end[axis];
    }
    return contains;
  }
};

/// The values of a field at the nodes of a box, first axis fastest.
struct FieldWithin
{
  const float* values;
  NodesWithin box;

  LIMPID_HD Index At(const Int3& node) const
  {
    const Int3 size = this->box.end - this->box.begin;
    const Int3 local = node - this->box.begin;
    return local.x + size.x * (local.y + Index(size.y) * local.z);
  }

  LIMPID_HD float operator[](const Int3& node) const { return this->values[this->At(node)]; }

  /// Whether the neighbourhood of a node is steep, see IsSteep.
  LIMPID_HD bool IsSteepAt(const Int3& node) const
  {
    const Int3 last = this->box.end - 1;
    float least = (*this)[node];
    float most = least;
    for (int k = AtLeast(node.z - 1, this->box.begin.z); k <= AtMost(node.z + 1, last.z); ++k)
    {
      for (int j = AtLeast(node.y - 1, this->box.begin.y); j <= AtMost(node.y + 1, last.y); ++j)
      {
        for (int i = AtLeast(node.x - 1, this->box.begin.x); i <= AtMost(node.x + 1, last.x); ++i)
        {
          const float value = (*this)[Int3(i, j, k)];
          least = AtMost(least, value);
          most = AtLeast(most, value);
        }
      }
    }
    return IsSteep(least, most);
  }
};

/**
 * The optical depth between a node and a source of rays, Eq. (15), exact up to rounding: within a
 * cell a trilinear extinction is cubic along a ray, and two Gauss points integrate it exactly.
 */
class NodeRays
{
public:
  NodeRays(const Grid& grid, const RaySource& source);

  /// Whether the source has a ray to a node.
  LIMPID_HD bool See(const Int3& node) const
  {
    const Vec3 ray = this->Parallel ? Vec3(node) : Vec3(node) - this->Origin;
    bool inView = true;
    for (int plane = 0; plane < this->PlaneCount; ++plane)
    {
      inView =
        inView && !(glm::dot(this->Planes[plane].normal, ray) + this->Planes[plane].offset < 0);
    }
    return inView;
  }

  /// Returns the optical depth of some cells, given by their first nodes; values beyond
  /// darkWholeDepth may be too small. `counts(cell)`: whether a cell is included. The field must
  /// contain the nodes of all included cells.
  template <class Counts>
  LIMPID_HD WholeDepth DepthTo(const Int3& node, const FieldWithin& extinction,
    const NodesWithin& cells, const Counts& counts) const
  {
    Walk walk(node, this->Parallel ? -this->Origin : this->Origin - Vec3(node), this->LastCell);
    const double end = walk.EndOf(cells, this->Parallel ? HUGE_VAL : 1.0);
    const double length = glm::length(walk.way * this->Spacing);
    WholeDepth depth = 0;
    double at = walk.Enter(cells);
    while (at < end && depth < darkWholeDepth)
    {
      const int axis = walk.NextAxis();
      const double next = glm::min(walk.face[axis], end);
      if (next > at && counts(walk.cell)) // it may cross several faces at once
      {
        const double here = MeanAlong(extinction, walk, at, next) * (next - at) * length;
        depth += static_cast<WholeDepth>(
          glm::min(double(darkWholeDepth), here * unitsOfDepth + 0.5)); // limits overflow, too
      }
      walk.Cross(axis);
      at = next;
    }
    return depth;
  }

private:
  /// A path from a node through the cells of the grid: node + t way.
  struct Walk
  {
    Vec3 node;
    Vec3 way;
    Vec3 slowness; ///< 1 / way
    Int3 onward;   ///< step from cell to cell along each axis: 1, -1 or 0
    Int3 cell;
    double face[3]; ///< t at which the path leaves the cell along each axis

    LIMPID_HD Walk(const Int3& from, const Vec3& along, const Int3& lastCell)
      : node(from)
      , way(along)
      , slowness(1.0 / along)
      , onward(glm::sign(along))
      , cell(glm::min(from, lastCell))
      , face{ HUGE_VAL, HUGE_VAL, HUGE_VAL }
    {
    }

    /// t at which the path meets a plane of nodes.
    LIMPID_HD double At(int axis, int plane) const
    {
      return (double(plane) - this->node[axis]) * this->slowness[axis];
    }

    /// t at which the path leaves a cell along an axis.
    LIMPID_HD double FaceOf(int axis, int cellThere) const
    {
      return this->At(axis, cellThere + (this->onward[axis] > 0 ? 1 : 0));
    }

    /// t at which the path leaves a box of cells, given by their first nodes, but at most `last`.
    LIMPID_HD double EndOf(const NodesWithin& cells, double last) const
    {
      double end = last;
      for (int axis = 0; axis < 3; ++axis)
      {
        if (this->onward[axis] != 0)
        {
          end = glm::min(
            end, this->At(axis, this->onward[axis] > 0 ? cells.end[axis] : cells.begin[axis]));
        }
        else if (this->cell[axis] < cells.begin[axis] || this->cell[axis] >= cells.end[axis])
        {
          return 0;
        }
      }
      return end;
    }

    /// Moves to where the path enters a box of cells, and returns t there.
    LIMPID_HD double Enter(const NodesWithin& cells)
    {
      double at = 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const int first = this->onward[axis] > 0 ? cells.begin[axis] : cells.end[axis];
        if (this->onward[axis] * (first - this->node[axis]) > 0)
        {
          at = glm::max(at, this->At(axis, first));
        }
      }
      for (int axis = 0; axis < 3; ++axis)
      {
        this->Locate(axis, at);
      }
      return at;
    }

    /// Finds the cell along an axis just behind `at`, consistently with Cross.
    LIMPID_HD void Locate(int axis, double at)
    {
      int& here = this->cell[axis];
      if (this->onward[axis] == 0)
      {
        return;
      }
      here = static_cast<int>(std::floor(this->node[axis] + at * this->way[axis]));
      while (this->FaceOf(axis, here - this->onward[axis]) > at)
      {
        here -= this->onward[axis];
      }
      while (this->FaceOf(axis, here) <= at)
      {
        here += this->onward[axis];
      }
      this->face[axis] = this->FaceOf(axis, here);
    }

    /// The axis along which the path meets a face next.
    LIMPID_HD int NextAxis() const
    {
      const int first = this->face[0] <= this->face[1] ? 0 : 1;
      return this->face[first] <= this->face[2] ? first : 2;
    }

    LIMPID_HD void Cross(int axis)
    {
      this->cell[axis] += this->onward[axis];
      this->face[axis] = this->FaceOf(axis, this->cell[axis]);
    }
  };

  /// Returns the mean extinction between two points of the path in a cell [1/length].
  LIMPID_HD static double MeanAlong(
    const FieldWithin& extinction, const Walk& walk, double begin, double end)
  {
    const Int3 size = extinction.box.end - extinction.box.begin;
    const Index row = size.x;
    const Index slice = row * size.y;
    const float* front = extinction.values + extinction.At(walk.cell);
    const float* back = front + slice;
    const float most =
      AtLeast(AtLeast(AtLeast(front[0], front[1]), AtLeast(front[row], front[row + 1])),
        AtLeast(AtLeast(back[0], back[1]), AtLeast(back[row], back[row + 1])));
    if (!(most > 0.0f))
    {
      return 0;
    }
    constexpr double shares[2] = { gaussPoints[0], gaussPoints[1] };
    float sum = 0;
    for (int half = 0; half < 2; ++half)
    {
      const double at = begin + shares[half] * (end - begin);
      const glm::vec3 place = walk.node + at * walk.way - Vec3(walk.cell);
      const auto along = [&](const float* edge) { return edge[0] + place.x * (edge[1] - edge[0]); };
      const auto across = [&](const float* side)
      { return along(side) + place.y * (along(side + row) - along(side)); };
      sum += AtLeast(across(front) + place.z * (across(back) - across(front)), 0.0f);
    }
    return 0.5 * double(sum);
  }

  bool Parallel;
  Vec3 Origin; ///< for a parallel source, its direction of travel
  Vec3 Spacing;
  Int3 LastCell;
  int PlaneCount = 0;
  RaySource::Plane Planes[4];
};

/// Copies the transmittance that a sweep has computed, but recomputes it at nodes where it is
/// steep, along their own rays. All arrays hold one value per node on the device.
template <class AnyDevice>
void RefineTransmittance(AnyDevice& device, const Grid& grid, const RaySource& source,
  const float* extinction, const float* swept, float* transmittance);
}

#endif
