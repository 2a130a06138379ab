// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What happens at one node of a overlay, the same for all backends.

#ifndef limpid_render_ExtinctionOverlayNode_h
#define limpid_render_ExtinctionOverlayNode_h

#include "backend/Simd.h"
#include "math/Vec.h"
#include "render/RayLight.h"

namespace limpid
{
/// A share [0, 1] in units of packedOne.
LIMPID_HD LIMPID_INLINE std::int16_t PackShare(float value)
{
  const float inside = value < 0.0f ? 0.0f : (1.0f < value ? 1.0f : value);
  return static_cast<std::int16_t>(inside * packedOne + 0.5f);
}

/// Moves the change of an extinction, see OverlayField, by a share of the way to another one.
struct OverlayNode
{
  int nodes[3];
  const float* base;       ///< [1/length]
  const float* extinction; ///< where to move to [1/length]
  float perUnit;           ///< 1 / majorant [length]
  float share;
  float rescale;        ///< the majorant that `packed` is in over the new one
  std::int16_t* packed; ///< in and out

  /// Returns whether anything is changed at the node.
  LIMPID_HD LIMPID_INLINE bool Move(Index node, int i, int j, int k) const
  {
    std::int16_t* here = this->packed + 4 * node;
    const std::int16_t kept = PackShare(this->Kept(node, i, j, k));
    const std::int16_t added =
      PackShare((this->extinction[node] - this->base[node]) * this->perUnit);
    here[0] = this->Eased(here[0], 1.0f, kept);
    here[1] = this->Eased(here[1], this->rescale, added);
    return here[0] != std::int16_t(packedOne) || here[1] != 0;
  }

private:
  LIMPID_HD LIMPID_INLINE std::int16_t Eased(std::int16_t from, float unit, std::int16_t goal) const
  {
    const float old = from * unit;
    const float now = packedOne < old ? packedOne : old;
    const float next = now + this->share * (float(goal) - now);
    return static_cast<std::int16_t>(next + 0.5f);
  }

  LIMPID_HD LIMPID_INLINE float KeptOf(Index node) const
  {
    const float kept = this->extinction[node] / this->base[node];
    return 1.0f < kept ? 1.0f : kept;
  }

  /// Share of the base extinction that is kept; where there is none, the mean of the neighbours
  /// that have some.
  LIMPID_HD LIMPID_INLINE float Kept(Index node, int i, int j, int k) const
  {
    if (this->base[node] > 0)
    {
      return this->KeptOf(node);
    }
    const int at[3] = { i, j, k };
    float sum = 0;
    int count = 0;
    Index stride = 1;
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int side = -1; side <= 1; side += 2)
      {
        const int neighbour = at[axis] + side;
        if (neighbour >= 0 && neighbour < this->nodes[axis] && this->base[node + side * stride] > 0)
        {
          sum += this->KeptOf(node + side * stride);
          ++count;
        }
      }
      stride *= this->nodes[axis];
    }
    return count > 0 ? sum / float(count) : 1.0f;
  }
};

/// The extinction that a node of a overlay shows. `unit`: of what is added [1/length].
LIMPID_HD LIMPID_INLINE float ShownExtinctionOf(float base, const std::int16_t* packed, float unit)
{
  const float kept = base * (packed[0] / packedOne);
  return kept + unit * (packed[1] / packedOne);
}

/// Where a node of an axis lies between those of another one over the same length.
struct AxisPlace
{
  int before;  ///< the other node at or before
  float share; ///< of the way to the one behind it

  /// `from`: nodes of the other axis; `to`: of this one.
  LIMPID_HD static LIMPID_INLINE AxisPlace Of(int node, int from, int to)
  {
    const double ratio = double(from - 1) / (to > 2 ? to - 1 : 1);
    const int place = static_cast<int>(node * ratio);
    const int most = from > 2 ? from - 2 : 0;
    const int before = place < most ? place : most;
    return { before, static_cast<float>(node * ratio - before) };
  }
};
}

#endif
