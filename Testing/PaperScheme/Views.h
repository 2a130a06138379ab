// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_PaperScheme_Views_h
#define limpid_testing_PaperScheme_Views_h

#include "math/Vec.h"

namespace limpid::reference
{
template <class Real>
using Vec3Of = glm::vec<3, Real, glm::defaultp>;

/// Where a trilinear interpolation takes its eight values, and in which proportion.
template <class Real>
struct TrilinearPlace
{
  Index corner;         ///< offset of the corner with the lowest coordinates
  Index steps[3];       ///< offsets to the neighbour along each axis; 0 where there is none
  Vec3Of<Real> weights; ///< of that neighbour, [0, 1]
};

/// The place of `position`, in units of samples, in an array of `size` samples that lie `strides`
/// apart. Positions outside take the nearest value at the border.
template <class Real>
inline TrilinearPlace<Real> Locate(
  const Vec3Of<Real>& position, const Int3& size, const Index (&strides)[3])
{
  TrilinearPlace<Real> place;
  place.corner = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int last = size[axis] - 1;
    const int lastCorner = last > 0 ? last - 1 : 0;
    Real inside = position[axis] > 0 ? position[axis] : Real(0);
    inside = inside < Real(last) ? inside : Real(last);
    int corner = static_cast<int>(inside);
    corner = corner < lastCorner ? corner : lastCorner;
    place.corner += corner * strides[axis];
    place.steps[axis] = last > 0 ? strides[axis] : 0;
    place.weights[axis] = inside - Real(corner);
  }
  return place;
}

template <class Real>
inline Real Interpolate(const Real* values, const TrilinearPlace<Real>& place)
{
  const Real* v = values + place.corner;
  const Index x = place.steps[0];
  const Index y = place.steps[1];
  const Index z = place.steps[2];
  const Vec3Of<Real>& w = place.weights;
  const Real v00 = v[0] + w.x * (v[x] - v[0]);
  const Real v10 = v[y] + w.x * (v[x + y] - v[y]);
  const Real v01 = v[z] + w.x * (v[x + z] - v[z]);
  const Real v11 = v[y + z] + w.x * (v[x + y + z] - v[y + z]);
  const Real v0 = v00 + w.y * (v10 - v00);
  const Real v1 = v01 + w.y * (v11 - v01);
  return v0 + w.z * (v1 - v0);
}

/// A sample on a face of the box belongs to the box, whichever way its position was rounded
/// [index].
template <class Real>
constexpr Real boxSlack = Real(1e-4);

/// A field on the nodes of a limpid::Grid, first axis fastest; zero outside the box of the nodes.
template <class Real>
struct FieldView
{
  const Real* values = nullptr; ///< shape nodes, any unit
  Int3 nodes{ 0 };
};

/// Whether a position in index space lies in the box of the nodes.
template <class Real>
inline bool IsInBox(const Int3& nodes, const Vec3Of<Real>& position)
{
  const Real slack = boxSlack<Real>;
  return position.x >= -slack && position.x <= Real(nodes.x - 1) + slack && position.y >= -slack &&
    position.y <= Real(nodes.y - 1) + slack && position.z >= -slack &&
    position.z <= Real(nodes.z - 1) + slack;
}

/// The place of a position in index space in arrays over the nodes.
template <class Real>
inline TrilinearPlace<Real> LocateInNodes(const Int3& nodes, const Vec3Of<Real>& position)
{
  const Index strides[3] = { 1, nodes.x, Index(nodes.x) * nodes.y };
  return Locate(position, nodes, strides);
}

/// Value of a field at a position in index space.
template <class Real>
inline Real Sample(const FieldView<Real>& field, const Vec3Of<Real>& position)
{
  return IsInBox(field.nodes, position)
    ? Interpolate(field.values, LocateInNodes(field.nodes, position))
    : Real(0);
}

/// Product of two fields on the same nodes at a position in index space.
template <class Real>
inline Real SampleProduct(
  const FieldView<Real>& one, const FieldView<Real>& other, const Vec3Of<Real>& position)
{
  if (!IsInBox(one.nodes, position))
  {
    return 0;
  }
  const TrilinearPlace<Real> place = LocateInNodes(one.nodes, position);
  return Interpolate(one.values, place) * Interpolate(other.values, place);
}

/// A quantity on the cells of a perspective grid; `Value` is const where it is only read.
template <class Value>
struct GridView
{
  Value* values = nullptr; ///< shape cells = (X, Y, Z)
  Int3 cells{ 0 };

  /// Rays side by side are neighbours in memory, so that lookups from neighbouring voxels share
  /// cache lines.
  Index Stride(int axis) const
  {
    return axis == 0 ? 1 : axis == 1 ? Index(cells.x) : Index(cells.x) * cells.y;
  }

  Value& operator()(int i, int j, int k) const
  {
    return values[i * Stride(0) + j * Stride(1) + k * Stride(2)];
  }
};

/// The place of a position, in units of cells as PerspectiveMap::ToCells gives it.
template <class Real>
inline TrilinearPlace<Real> LocateInGrid(
  const GridView<const Real>& grid, const Vec3Of<Real>& position)
{
  const Index strides[3] = { grid.Stride(0), grid.Stride(1), grid.Stride(2) };
  return Locate(position, grid.cells, strides);
}
}

#endif
