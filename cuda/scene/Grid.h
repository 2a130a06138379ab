// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_Grid_h
#define limpid_scene_Grid_h

#include "math/Vec.h"

namespace limpid
{
/// Range of lengths within which single precision can represent all quantities that are computed
/// from them and from extinctions (SceneProperties.DoNotDependOnTheUnitOfLength). Below 1e-23 and
/// above 1e26 results change.
constexpr double leastLength = 1e-20;
constexpr double mostLength = 1e24;

/**
 * The nodes of an image: their positions, and the map from index space to the world.
 *
 * Index space has its origin at the first node and one unit per node along each axis. All sweeps
 * work in it, so they need not handle anisotropic spacing, extents and direction matrices. Fields
 * over a grid are arrays of NodeCount() values, first axis fastest.
 */
struct Grid
{
  Int3 nodes{ 0 };       ///< number of nodes along each axis
  Vec3 origin{ 0.0 };    ///< world position of node (0,0,0)             [length]
  Vec3 spacing{ 1.0 };   ///< distance of neighbouring nodes, above zero [length]
  Mat3 direction{ 1.0 }; ///< columns: world directions of the grid axes, orthonormal

  Index NodeCount() const { return Index(nodes.x) * nodes.y * nodes.z; }

  /// Returns whether the box of the nodes has a volume: at least two nodes along each axis.
  bool HasVolume() const { return nodes.x > 1 && nodes.y > 1 && nodes.z > 1; }

  /// Returns the volume of one cell [length^3].
  double CellVolume() const { return spacing.x * spacing.y * spacing.z; }

  Vec3 PointToIndex(const Vec3& world) const;
  Vec3 PointToWorld(const Vec3& index) const;
  Vec3 DirectionToIndex(const Vec3& world) const;

  /// Returns the centre of the box of the nodes [length].
  Vec3 Centre() const;

  /// Returns R of the normalised coordinates: half the diagonal of the box of the nodes [length].
  double Radius() const;

  /// Returns whether the first and the last node equal those of another grid, to 1e-4 of the
  /// radius.
  bool HasSameBox(const Grid& other) const;

  /// Throws limpid::Error if sizes, spacing or direction are invalid.
  void Require() const;
};
}

#endif
