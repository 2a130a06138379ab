// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Smoothing_h
#define limpid_optimize_Smoothing_h

#include "math/Macros.h"
#include "math/Range.h"
#include "math/Vec.h"

namespace limpid
{
class HostDevice;

/// Number of policy sweeps that smooth the change near the optimum.
inline constexpr int smoothingSweeps = 6;

/**
 * The value a towards which smoothing pulls the change c = mu - mu-bar of a voxel
 * (Documentation/Deviations.md, D18). The next iterate minimises the energy of Eq. (21) plus sigma
 * / 2 (mu - mu-bar - a)^2 with
 *
 *    a = max( c + k (m - c), -mu-bar ),
 *
 * where m is the mean change of the neighbours. Cleared voxels return half as readily, k = 1/2.
 * Unimportant voxels are removed up to three times as readily, k = 3 (1 - g)^2, as they then hide
 * nothing.
 */
template <class Real>
struct SmoothedChange
{
  Real base;       ///< mu-bar [1/length]
  Real change;     ///< c [1/length]
  Real importance; ///< g [0, 1]

  /// Returns a [1/length] for m [1/length].
  LIMPID_HD LIMPID_INLINE Real operator()(Real mean) const
  {
    const Real toMean = mean - this->change;
    const Real unimportant = Real(1) - this->importance;
    const Real back = this->change < 0 ? Real(0.5) : Real(1);
    const Real away = this->change > 0 ? Real(1) : Real(3) * unimportant * unimportant;
    const Real drawn = this->change + (toMean > 0 ? back : away) * toMean;
    return drawn > -this->base ? drawn : -this->base;
  }
};

/// Weight of a neighbour: binomial in its distance along each axis.
LIMPID_HD LIMPID_INLINE float NeighborWeight(int dx, int dy, int dz)
{
  const int steps = (dx != 0) + (dy != 0) + (dz != 0);
  return static_cast<float>(8 >> steps);
}

/// The pull of smoothing at one node, as a derivative that is added to that of the other terms.
struct SmoothedNode
{
  Int3 nodes;
  const float* base;       ///< [1/length]
  const float* importance; ///< [0, 1]
  const float* last;       ///< the last iterate [1/length]
  const float* lagged;     ///< derivative of the terms that are not swept; null if none
  float strength;          ///< sigma [length]
  float* pull;             ///< out: that derivative minus sigma a; may be the same array

  /// Whether a node is not empty; empty nodes neither have nor are neighbours.
  LIMPID_HD LIMPID_INLINE bool IsFilled(Index node) const
  {
    return this->base[node] > 0 || this->last[node] > 0;
  }

  LIMPID_HD LIMPID_INLINE void operator()(Index node, int i, int j, int k) const
  {
    float sum = 0;
    float weights = 0;
    for (int dz = k > 0 ? -1 : 0; dz <= (k + 1 < this->nodes.z ? 1 : 0); ++dz)
    {
      for (int dy = j > 0 ? -1 : 0; dy <= (j + 1 < this->nodes.y ? 1 : 0); ++dy)
      {
        for (int dx = i > 0 ? -1 : 0; dx <= (i + 1 < this->nodes.x ? 1 : 0); ++dx)
        {
          const Index other = node + (Index(dz) * this->nodes.y + dy) * this->nodes.x + dx;
          if (other != node && this->IsFilled(other))
          {
            const float weight = NeighborWeight(dx, dy, dz);
            sum += weight * (this->last[other] - this->base[other]);
            weights += weight;
          }
        }
      }
    }
    const float change = this->last[node] - this->base[node];
    this->Write(node, weights > 0 ? sum / weights : change);
  }

  /// `mean`: mean change of the neighbours, or the own change if there are none [1/length].
  LIMPID_HD LIMPID_INLINE void Write(Index node, float mean) const
  {
    const SmoothedChange<float> drawn{ this->base[node], this->last[node] - this->base[node],
      this->importance[node] };
    const float towards = this->IsFilled(node) ? drawn(mean) : 0.0f;
    this->pull[node] = (this->lagged ? this->lagged[node] : 0.0f) - this->strength * towards;
  }
};

/// Computes the pull at all nodes.
template <class AnyDevice>
void FindPull(AnyDevice& device, const SmoothedNode& body, const Range<int>&)
{
  device.ForNodes("smooth", body.nodes, body);
}

/// The version for the processor sums neighbours row by row in registers and computes only the
/// given slices along z.
void FindPull(HostDevice& device, const SmoothedNode& body, const Range<int>& slices);
}

#endif
