// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What decides whether a brick is empty, the same for all backends.

#ifndef limpid_render_BrickNodes_h
#define limpid_render_BrickNodes_h

#include "backend/Simd.h"
#include "math/Vec.h"
#include "render/RayScene.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
/// Distance of bricks that are not closer to any that is not empty: what fits into a byte.
constexpr int farthestBrick = 255;

/// The box of nodes from which the cells of a brick are interpolated.
struct BrickNodes
{
  int first[3];
  int last[3];

  /// Brick (i, j, k) of a grid with so many nodes along the axes.
  LIMPID_HD static LIMPID_INLINE BrickNodes Of(
    int i, int j, int k, int nodesX, int nodesY, int nodesZ)
  {
    constexpr int size = BrickDistances::size;
    BrickNodes box{ { size * i, size * j, size * k },
      { size * i + size, size * j + size, size * k + size } };
    box.last[0] = box.last[0] < nodesX - 1 ? box.last[0] : nodesX - 1;
    box.last[1] = box.last[1] < nodesY - 1 ? box.last[1] : nodesY - 1;
    box.last[2] = box.last[2] < nodesZ - 1 ? box.last[2] : nodesZ - 1;
    return box;
  }

  /// The same cells on an axis with other nodes over the same length.
  LIMPID_HD LIMPID_INLINE BrickNodes On(int nodes, int otherNodes, int axis) const
  {
    const double scale = double(otherNodes - 1) / (nodes > 2 ? nodes - 1 : 1);
    const int low = int(std::floor(this->first[axis] * scale - 1e-6));
    const int high = int(std::ceil(this->last[axis] * scale + 1e-6));
    BrickNodes box = *this;
    box.first[axis] = Inside(low, otherNodes);
    box.last[axis] = Inside(high, otherNodes);
    return box;
  }

  /// Calls use(node); there are `nodesX` nodes in a row and `nodesY` rows in a slice.
  template <class Use>
  LIMPID_HD LIMPID_INLINE void ForEach(int nodesX, int nodesY, const Use& use) const
  {
    for (int k = this->first[2]; k <= this->last[2]; ++k)
    {
      for (int j = this->first[1]; j <= this->last[1]; ++j)
      {
        const Index row = nodesX * (j + Index(nodesY) * k);
        for (int i = this->first[0]; i <= this->last[0]; ++i)
        {
          use(row + i);
        }
      }
    }
  }

private:
  LIMPID_HD static LIMPID_INLINE int Inside(int node, int nodes)
  {
    const int atLeast = node > 0 ? node : 0;
    return atLeast < nodes - 1 ? atLeast : nodes - 1;
  }
};

struct ScalarRange
{
  float least = 3.4e38f;
  float most = -3.4e38f;

  LIMPID_HD LIMPID_INLINE void Include(float value)
  {
    this->least = std::min(this->least, value);
    this->most = std::max(this->most, value);
  }
};

/// The most that a change can make of an extinction, see OverlayField.
struct LargestChange
{
  int kept = 0;
  int added = 0;

  LIMPID_HD LIMPID_INLINE void Include(const std::int16_t* packed)
  {
    this->kept = this->kept < packed[0] ? packed[0] : this->kept;
    this->added = this->added < packed[1] ? packed[1] : this->added;
  }

  /// Above zero if the extinction is, which is all that counts.
  LIMPID_HD LIMPID_INLINE float Of(float extinction) const
  {
    return extinction * static_cast<float>(this->kept) + static_cast<float>(this->added);
  }
};
}

#endif
