// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_NodeBox_h
#define limpid_scene_NodeBox_h

#include "math/Range.h"
#include "math/Vec.h"

#include <algorithm>
#include <array>

namespace limpid
{
/// A box of nodes of a grid: half-open ranges along each axis.
struct NodeBox
{
  std::array<Range<int>, 3> along;

  static NodeBox Of(const Int3& nodes)
  {
    return { { { { 0, nodes.x }, { 0, nodes.y }, { 0, nodes.z } } } };
  }

  /// Returns the first node along each axis.
  Int3 First() const
  {
    return { this->along[0].begin, this->along[1].begin, this->along[2].begin };
  }

  bool Empty() const
  {
    return this->along[0].Empty() || this->along[1].Empty() || this->along[2].Empty();
  }

  Int3 Size() const
  {
    return { this->along[0].Length(), this->along[1].Length(), this->along[2].Length() };
  }

  Index Count() const
  {
    const Int3 size = this->Size();
    return this->Empty() ? 0 : Index(size.x) * size.y * size.z;
  }

  friend bool operator==(const NodeBox& a, const NodeBox& b)
  {
    return std::equal(a.along.begin(), a.along.end(), b.along.begin(),
      [](const Range<int>& one, const Range<int>& other)
      { return one.begin == other.begin && one.end == other.end; });
  }

  /// Returns the box extended by this number of nodes on every side, clipped to the grid; an empty
  /// box is unchanged.
  NodeBox Grown(int nodes, const Int3& grid) const
  {
    NodeBox grown = *this;
    for (int axis = 0; axis < 3 && !this->Empty(); ++axis)
    {
      Range<int>& range = grown.along[std::size_t(axis)];
      range = limpid::Grown(range, nodes, grid[axis]);
    }
    return grown;
  }

  friend NodeBox Intersection(const NodeBox& a, const NodeBox& b)
  {
    NodeBox both;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      both.along[axis] = Intersection(a.along[axis], b.along[axis]);
    }
    return both;
  }
};
}

#endif
