// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_PaperScheme_PerspectiveMap_h
#define limpid_testing_PaperScheme_PerspectiveMap_h

#include "PaperScheme/Views.h"
#include "math/Range.h"
#include "math/Vec.h"

#include <cmath>

namespace limpid
{
struct Grid;
}

namespace limpid::reference
{
/**
 * The perspective mapping of Eqs. (12) and (13) and the grid of X x Y x Z cells over its range
 * [-1,1] x [-1,1] x [0,1].
 *
 * "World" is the index space of a limpid::Grid here: Eqs. (12) and (13) hold in any affine frame,
 * and in this one a sample of a field and a lookup from a voxel need no further transformation.
 * Depths and lengths are in normalised coordinates, that is, in radii of the box. The rotation R of
 * the paper is the identity: the eye is where it is.
 *
 * The sample y(i,j,k) of Eqs. (17) to (20) is the middle of the front face of cell (i,j,k).
 */
template <class Real>
struct PerspectiveMap
{
  using Vec = Vec3Of<Real>;

  Vec origin{ 0 };   ///< o, the eye                                       [index]
  Vec u{ 1, 0, 0 };  ///< half the width of the picture at depth 1         [index]
  Vec v{ 0, 1, 0 };  ///< half its height                                  [index]
  Vec w{ 0, 0, 1 };  ///< from the eye to the picture's middle at depth 1  [index]
  Vec inverse[3] = { ///< v x w, w x u and u x v, each over det(u, v, w)   [1/index]
    Vec{ 1, 0, 0 }, Vec{ 0, 1, 0 }, Vec{ 0, 0, 1 }
  };
  Vec unit{ 1 };      ///< length of an index step along each axis          [normalised length]
  Real nearDepth = 1; ///< z_n, along w                                     [normalised length]
  Real farDepth = 2;  ///< z_f, along w                                     [normalised length]
  Int3 cells{ 1 };    ///< X, Y, Z

  void SetFrame(const Vec& newU, const Vec& newV, const Vec& newW)
  {
    u = newU;
    v = newV;
    w = newW;
    const Real determinant = glm::dot(glm::cross(u, v), w);
    inverse[0] = glm::cross(v, w) / determinant;
    inverse[1] = glm::cross(w, u) / determinant;
    inverse[2] = glm::cross(u, v) / determinant;
  }

  Index RayCount() const { return Index(cells.x) * cells.y; }
  Index CellCount() const { return RayCount() * cells.z; }

  /// Eq. (12): from index space to view space.
  Vec ToView(const Vec& world) const
  {
    const Vec ray = world - origin;
    const Real depth = glm::dot(inverse[2], ray);
    return Vec(glm::dot(inverse[0], ray) / depth, glm::dot(inverse[1], ray) / depth,
      (depth - nearDepth) / (farDepth - nearDepth));
  }

  /// Eq. (13): from view space to index space.
  Vec ToWorld(const Vec& view) const
  {
    return (u * view.x + v * view.y + w) * (nearDepth + (farDepth - nearDepth) * view.z) + origin;
  }

  /// From view space to units of cells: y(i,j,k) is at (i, j, k).
  Vec ToCells(const Vec& view) const
  {
    return Vec((view.x + 1) / 2 * Real(cells.x) - Real(0.5),
      (view.y + 1) / 2 * Real(cells.y) - Real(0.5), view.z * Real(cells.z));
  }

  /// y(i,j,k) of Eqs. (17) to (20), in view space.
  Vec SampleInView(int i, int j, int k) const
  {
    return Vec((2 * Real(i) + 1) / Real(cells.x) - 1, (2 * Real(j) + 1) / Real(cells.y) - 1,
      Real(k) / Real(cells.z));
  }

  /// g_V^-1(y(i,j,k)) [index].
  Vec SampleInWorld(int i, int j, int k) const { return ToWorld(SampleInView(i, j, k)); }

  /// h of Eqs. (17) to (20): the length of a cell along its own ray, since an oblique ray crosses a
  /// slab of equal depth on a longer path (deviation D2) [normalised length].
  Real CellLength(int i, int j) const
  {
    const Vec view = SampleInView(i, j, 0);
    const Vec slope = unit * (u * view.x + v * view.y + w);
    return std::sqrt(glm::dot(slope, slope)) * (farDepth - nearDepth) / Real(cells.z);
  }

  /// Volume that the sample y(i,j,k) stands for: the Jacobian of Eq. (13) there times the extent of
  /// a cell in view space [normalised length^3].
  Real CellVolume(int k) const
  {
    const Real depth = nearDepth + (farDepth - nearDepth) * Real(k) / Real(cells.z);
    const Real determinant = glm::dot(glm::cross(unit * u, unit * v), unit * w);
    const Real extent = 4 / (Real(cells.x) * Real(cells.y) * Real(cells.z));
    return std::abs(determinant) * depth * depth * (farDepth - nearDepth) * extent;
  }
};

/// The samples of ray (i,j) that may lie in the box of `nodes`, one more at each end in doubt: the
/// others need not be looked at to know that nothing is there.
template <class Real>
inline Range<int> SamplesInBox(const PerspectiveMap<Real>& map, const Int3& nodes, int i, int j)
{
  const Vec3Of<Real> start = map.SampleInWorld(i, j, 0);
  const Vec3Of<Real> step = (map.SampleInWorld(i, j, map.cells.z) - start) / Real(map.cells.z);
  Real first = 0;
  Real last = Real(map.cells.z);
  for (int axis = 0; axis < 3; ++axis)
  {
    const Real toFront = -boxSlack<Real> - start[axis];
    const Real toBack = Real(nodes[axis] - 1) + boxSlack<Real> - start[axis];
    // A ray that keeps its distance from the faces so well is within or without for all samples.
    const Real pace =
      std::abs(step[axis]) > Real(1e-9) ? step[axis] : std::copysign(Real(1e-9), step[axis]);
    const Real one = toFront / pace;
    const Real other = toBack / pace;
    const Real enter = (one < other ? one : other) - 1;
    const Real leave = (one < other ? other : one) + 2;
    first = first > enter ? first : enter;
    last = last < leave ? last : leave;
  }
  if (!(first < last))
  {
    return { map.cells.z, map.cells.z };
  }
  return { static_cast<int>(first), static_cast<int>(last) };
}

/**
 * The map of an eye that looks at the centre of the box of `grid` and sees all of it; `eye` is in
 * world coordinates. Throws limpid::Error unless the whole box lies in front of the eye.
 *
 * `samplesPerVoxel` sets the cells: so many samples per node distance along u, v and w, at the
 * depth of the centre.
 */
template <class Real>
PerspectiveMap<Real> LookAtBox(const Grid& grid, const Vec3& eye, double samplesPerVoxel);
}

#endif
