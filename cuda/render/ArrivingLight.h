// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The light that arrives at a surface, from the transmittance of the light at the nodes.

#ifndef limpid_render_ArrivingLight_h
#define limpid_render_ArrivingLight_h

#include "math/Vec.h"
#include "render/SingleSampler.h"
#include "scene/Grid.h"
#include "scene/NodeBox.h"
#include "scene/RaySource.h"

namespace limpid
{
/// Absorption on the last of the light's way to a place is no shadow: over a length of this number
/// of cells, up to this optical depth.
constexpr double ownCells = 4;
constexpr double mostOwnDepth = 7;

/// The matter of a surface lies within this number of cells of the shadows, along its normal.
constexpr double surfaceCells = 2.5;

/**
 * Computes the light that arrives at a node [0, 1]: T_L of Eq. (4) where the light reaches the
 * surface that the node belongs to, so that a surface casts no shadow on itself. That place is
 * in front of the node on the way of the light; if the surface is oblique, in front of it along its
 * normal. The result varies as smoothly as the transmittance does: a factor for what the surface
 * takes would also amplify the little light behind what casts a shadow.
 */
struct ArrivingNode
{
  const float* transmittance; ///< of the light
  const float* caster;        ///< extinction that casts the shadows [1/length]
  CellGrid cells;             ///< of both fields
  Int3 begin{ 0 };            ///< their first node in the grid, and their number of nodes
  Int3 size{ 0 };
  Int3 first{ 0 };      ///< first node of the result in the grid
  Int3 nodes{ 0 };      ///< of the grid
  bool parallel = true; ///< as in RaySource
  Vec3 origin{ 0 };     ///< position of a light that is not parallel [index]
  Vec3 direction{ 0 };  ///< of a parallel light [index]
  Vec3 spacing{ 1 };
  double ownLength = 0;     ///< see ownCells [length]
  double surfaceLength = 0; ///< see surfaceCells [length]
  float mostGiven = 1;      ///< exp(mostOwnDepth)
  float* arriving;          ///< out

  LIMPID_HD void operator()(Index out, int i, int j, int k) const
  {
    const Int3 node = this->first + Int3(i, j, k);
    const float here = this->transmittance[this->At(node)];
    this->arriving[out] = here < 1.0f ? this->Arriving(node, here) : here;
  }

  /// Places the fields and the result in the grid. `around`: nodes of the fields; `own`: of the
  /// result.
  void Within(const NodeBox& around, const NodeBox& own)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->begin[axis] = around.along[std::size_t(axis)].begin;
      this->first[axis] = own.along[std::size_t(axis)].begin;
    }
    this->size = around.Size();
    this->cells = CellGrid(this->size);
  }

  /// Returns the number of layers of nodes around the result that are read.
  int LayersRead() const;

private:
  /// `here`: the transmittance at the node.
  LIMPID_HD LIMPID_INLINE float Arriving(const Int3& node, float here) const
  {
    const Vec3 place(node);
    const float before = this->TransmittanceAt(place - this->OwnWay(place));
    const float outside = this->TransmittanceAt(place - this->WayIn(node));
    const float unshadowed = AtMost(before, here * this->mostGiven);
    return AtLeast(AtLeast(unshadowed, outside), here);
  }

  LIMPID_HD LIMPID_INLINE Index At(const Int3& node) const
  {
    Index at = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      at += (node[axis] - this->begin[axis]) * this->cells.stride[axis];
    }
    return at;
  }

  LIMPID_HD LIMPID_INLINE double LengthOf(const Vec3& way) const
  {
    return glm::length(way * this->spacing);
  }

  /// Returns the last of the light's way to a place [index].
  LIMPID_HD LIMPID_INLINE Vec3 OwnWay(const Vec3& place) const
  {
    const Vec3 way = this->parallel ? this->direction : place - this->origin;
    const double length = this->LengthOf(way);
    const double share = this->ownLength / (length > 0 ? length : 1.0);
    return way * (this->parallel || share < 1 ? share : 1.0);
  }

  /// Returns the way from the outside of a surface to a node, along the normal [index]: less than
  /// surfaceLength where the extinction is not steep, as there is no surface.
  LIMPID_HD LIMPID_INLINE Vec3 WayIn(const Int3& node) const
  {
    const Vec3 slope(this->Slope(node, 0), this->Slope(node, 1), this->Slope(node, 2));
    const Vec3 gradient = slope / this->spacing;
    const double steepness = glm::length(gradient);
    const double change = steepness * this->surfaceLength;
    const double whole = this->caster[this->At(node)];
    const double share = change < whole ? change / whole : 1.0;
    const Vec3 normal = gradient / (steepness > 0 ? steepness : 1.0);
    return share * this->surfaceLength * normal / this->spacing;
  }

  /// Returns the slope of the caster along an axis [1/length per node], over two nodes on both
  /// sides.
  LIMPID_HD LIMPID_INLINE double Slope(const Int3& node, int axis) const
  {
    double sum = 0;
    for (int distance = 1; distance <= 2; ++distance)
    {
      sum += distance *
        double(
          this->CasterBeside(node, axis, distance) - this->CasterBeside(node, axis, -distance));
    }
    return sum / 10;
  }

  LIMPID_HD LIMPID_INLINE float CasterBeside(Int3 node, int axis, int distance) const
  {
    const int last = this->begin[axis] + this->size[axis] - 1;
    node[axis] = Clamp(node[axis] + distance, this->begin[axis], last);
    return this->caster[this->At(node)];
  }

  /// Returns the transmittance at a place; 1 outside of the grid.
  LIMPID_HD LIMPID_INLINE float TransmittanceAt(const Vec3& place) const
  {
    float within[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      if (place[axis] < 0 || place[axis] > this->nodes[axis] - 1)
      {
        return 1;
      }
      within[axis] = float(place[axis] - this->begin[axis]);
    }
    return SingleSampler::InterpolateAll(
      this->cells, this->transmittance, CellPlace(this->cells, within));
  }
};

/// Returns the computation for all nodes of a grid, but for the fields. `cell`: spacing of the
/// nodes of the scalars [length]; the grid of the shadows may be coarser.
ArrivingNode ArrivingOn(const Grid& grid, const Vec3& cell, const RaySource& light);
}

#endif
