// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The transmittance of single nodes, each computed along its own ray.

#ifndef limpid_energy_NodeTransmittance_h
#define limpid_energy_NodeTransmittance_h

#include "energy/NodePath.h"
#include "math/Number.h"
#include "math/Vec.h"
#include "scene/Grid.h"
#include "scene/RaySource.h"

#include <cmath>
#include <cstdint>

namespace limpid
{
class HostDevice;

/// Whether the transmittance of neighbouring nodes, from `least` to `most`, varies so much that it
/// may jump between the rays of a sweep: by 0.1 where it is bright, by less where light shines
/// through gaps. With this limit the error at opaque blocks, shells, sheets and waves is within
/// 1e-3 rms of a march (TransmittanceAtNodes tests).
LIMPID_HD LIMPID_INLINE bool IsSteep(float least, float most)
{
  return (most - least) * (most - least) > 0.01f * most;
}

/// Returns exp(-depth), or 0 beyond darkWholeDepth.
LIMPID_HD inline float TransmittanceOf(std::int64_t depth)
{
  return depth >= darkWholeDepth
    ? 0.0f
    : static_cast<float>(std::exp(-static_cast<double>(depth) / double(unitsOfDepth)));
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

/// The rays of a source to the nodes of a grid.
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

  /// Returns the part of the path from a node to the source that is in a box of cells, given by
  /// their first nodes.
  LIMPID_HD NodePath<float> PathFrom(const Int3& node, const NodesWithin& cells) const
  {
    const Vec3 whole = this->Parallel ? -this->Origin : this->Origin - Vec3(node);
    const Vec3 most = glm::abs(whole);
    const double cellsAway = glm::max(glm::max(most.x, most.y), most.z);
    const Vec3 way = whole / (cellsAway > 0 ? cellsAway : 1.0);
    NodePath<float> path;
    path.length = static_cast<float>(glm::length(way * this->Spacing));
    for (int axis = 0; axis < 3; ++axis)
    {
      path.node[axis] = static_cast<float>(node[axis]);
      path.way[axis] = static_cast<float>(way[axis]);
      path.slowness[axis] = 1.0f / path.way[axis];
      const bool moves = Magnitude(path.slowness[axis]) < HUGE_VALF;
      path.onward[axis] = !moves ? 0 : path.way[axis] > 0.0f ? 1 : -1;
      path.cell[axis] = glm::min(node[axis], this->LastCell[axis]);
      path.face[axis] = HUGE_VALF;
    }
    Enter(path, cells, this->Parallel ? HUGE_VALF : static_cast<float>(glm::min(cellsAway, 1e30)));
    return path;
  }

  /// Returns the optical depth of some cells between a node and the source, Eq. (15); values beyond
  /// darkWholeDepth may be too small. `counts(cell)`: whether a cell is included. The field must
  /// contain the nodes of all included cells.
  template <class Counts>
  LIMPID_HD WholeDepth DepthTo(const Int3& node, const FieldWithin& extinction,
    const NodesWithin& cells, const Counts& counts) const
  {
    return this->PathFrom(node, cells).Depth(CornersInField<Counts>{ extinction, counts });
  }

private:
  /// Reads the corners of cells that count.
  template <class Counts>
  struct CornersInField
  {
    const FieldWithin& extinction;
    const Counts& counts;

    LIMPID_HD LIMPID_INLINE bool Read(
      const std::int32_t (&cell)[3], bool, CellCorners<float>& corners) const
    {
      const Int3 first(cell[0], cell[1], cell[2]);
      if (!this->counts(first))
      {
        return false;
      }
      const Int3 size = this->extinction.box.end - this->extinction.box.begin;
      const float* slice = this->extinction.values + this->extinction.At(first);
      float most = 0.0f;
      for (auto& rows : corners.at)
      {
        const float* row = slice;
        for (auto& nodes : rows)
        {
          nodes[0] = row[0];
          nodes[1] = row[1];
          most = AtLeast(most, AtLeast(row[0], row[1]));
          row += size.x;
        }
        slice += Index(size.x) * size.y;
      }
      return most > 0.0f;
    }
  };

  /// Moves a path to where it enters a box of cells, and lets it end where it leaves the box, but
  /// not behind `last`.
  LIMPID_HD static void Enter(NodePath<float>& path, const NodesWithin& cells, float last)
  {
    path.at = 0.0f;
    path.end = last;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int onward = path.onward[axis];
      const int first = onward > 0 ? cells.begin[axis] : cells.end[axis];
      if (onward == 0)
      {
        const bool beside =
          path.cell[axis] < cells.begin[axis] || path.cell[axis] >= cells.end[axis];
        path.end = beside ? 0.0f : path.end;
        continue;
      }
      path.end = AtMost(path.end, path.At(axis, onward > 0 ? cells.end[axis] : cells.begin[axis]));
      if (float(onward) * (float(first) - path.node[axis]) > 0.0f)
      {
        path.at = AtLeast(path.at, path.At(axis, first));
      }
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      Locate(path, axis);
    }
  }

  /// Finds the cell along an axis just behind where a path is, consistently with its crossings.
  LIMPID_HD static void Locate(NodePath<float>& path, int axis)
  {
    const int onward = path.onward[axis];
    if (onward == 0 || !(path.at < path.end))
    {
      return;
    }
    int& here = path.cell[axis];
    here = static_cast<int>(std::floor(path.node[axis] + path.at * path.way[axis]));
    while (path.FaceOf(axis, here - onward) > path.at)
    {
      here -= onward;
    }
    while (!(path.FaceOf(axis, here) > path.at))
    {
      here += onward;
    }
    path.face[axis] = path.FaceOf(axis, here);
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
void RefineTransmittance(HostDevice& device, const Grid& grid, const RaySource& source,
  const float* extinction, const float* swept, float* transmittance);
}

#endif
