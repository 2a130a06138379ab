// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The way from a node to a source of rays, cell by cell.

#ifndef limpid_energy_NodePath_h
#define limpid_energy_NodePath_h

#include "math/Number.h"
#include "sweep/HalfLayer.h"

#include <cstdint>

namespace limpid
{
/// An optical depth as an integer, so that sums do not depend on their order. Twice the depth that
/// counts as dark is the most that a path can sum up, and fits.
using WholeDepth = std::int32_t;
constexpr float unitsOfDepth = 1 << 25;

/// At an optical depth of 24, transmittance is negligible compared to 1 in single precision.
constexpr WholeDepth darkWholeDepth = 24 * (1 << 25);

/// A field at the corners of a cell.
template <class Number>
struct CellCorners
{
  Number at[2][2][2]; ///< [slice][row][column]

  /// `place`: from the first corner along each axis [0, 1].
  LIMPID_HD LIMPID_INLINE Number Interpolated(const Number (&place)[3]) const
  {
    const Number front =
      Between(InRow(this->at[0][0], place[0]), InRow(this->at[0][1], place[0]), place[1]);
    const Number back =
      Between(InRow(this->at[1][0], place[0]), InRow(this->at[1][1], place[0]), place[1]);
    return Between(front, back, place[2]);
  }

private:
  LIMPID_HD LIMPID_INLINE static Number InRow(const Number (&nodes)[2], const Number& share)
  {
    return Between(nodes[0], nodes[1], share);
  }

  LIMPID_HD LIMPID_INLINE static Number Between(
    const Number& one, const Number& other, const Number& share)
  {
    return one + share * (other - one);
  }
};

/**
 * The path from a node to a source, node + t way, and how far it has come. Its optical depth is
 * exact up to rounding: within a cell a trilinear extinction is cubic along a ray, and two Gauss
 * points integrate it exactly. `Number`: float, or FloatLanes for several paths side by side, which
 * have the same bits.
 *
 * Single precision places a path to 1e-4 of a cell in a grid of 2048 nodes, and an optical depth is
 * off by up to 1.5e-8 a cell.
 */
template <class Number>
struct NodePath
{
  using Whole = decltype(Truncate(Number()));

  Number node[3];     ///< [index]
  Number way[3];      ///< towards the source, a cell along the axis that it follows most [index]
  Number slowness[3]; ///< 1 / way
  Number length;      ///< of `way` [length]
  Number end;         ///< t at which it ends
  Number at;          ///< t
  Number face[3];     ///< t at which it leaves the cell along each axis
  Whole cell[3];      ///< first node of the cell
  Whole onward[3];    ///< step from cell to cell along each axis: 1, -1 or 0

  /// t at which the path meets a plane of nodes.
  LIMPID_HD LIMPID_INLINE Number At(int axis, const Whole& plane) const
  {
    return (ToFloat(plane) - this->node[axis]) * this->slowness[axis];
  }

  /// t at which the path leaves a cell along an axis.
  LIMPID_HD LIMPID_INLINE Number FaceOf(int axis, const Whole& cellThere) const
  {
    return this->At(axis, cellThere + ((this->onward[axis] + 1) >> 1));
  }

  /// Walks to the end and returns the optical depth on the way; values beyond darkWholeDepth may be
  /// too small. `corners.Read(cell, goesOn, extinction)` reads the extinction at the corners of a
  /// cell [1/length], or returns false if it is zero throughout or does not count; `goesOn`:
  /// whether the path is in that cell.
  template <class Corners>
  LIMPID_HD LIMPID_INLINE Whole Depth(const Corners& corners)
  {
    Whole depth(0);
    auto goesOn = this->at < this->end;
    while (AnyOf(goesOn))
    {
      const Number first = AtMost(AtMost(this->face[0], this->face[1]), this->face[2]);
      const Number next = AtMost(first, this->end);
      CellCorners<Number> extinction;
      if (corners.Read(this->cell, goesOn, extinction))
      {
        depth = depth + Select(goesOn, this->DepthUntil(next, extinction), Whole(0));
      }
      this->Cross(first);
      this->at = next;
      // Where a path has ended, its faces and cells mean nothing any more.
      goesOn = And(goesOn, And(next < this->end, depth < darkWholeDepth));
    }
    return depth;
  }

private:
  /// The optical depth between here and `next`, in one cell.
  LIMPID_HD LIMPID_INLINE Whole DepthUntil(
    const Number& next, const CellCorners<Number>& extinction) const
  {
    const Number size = next - this->at;
    constexpr float shares[2] = { float(gaussPoints[0]), float(gaussPoints[1]) };
    Number sum(0.0f);
    for (int half = 0; half < 2; ++half)
    {
      const Number t = this->at + shares[half] * size;
      const Number place[3] = { this->PlaceInCell(0, t), this->PlaceInCell(1, t),
        this->PlaceInCell(2, t) };
      sum = sum + AtLeast(extinction.Interpolated(place), 0.0f);
    }
    const Number depth = sum * this->length * size * (0.5f * unitsOfDepth);
    return Truncate(AtMost(depth + 0.5f, static_cast<float>(darkWholeDepth))); // limits overflow
  }

  LIMPID_HD LIMPID_INLINE Number PlaceInCell(int axis, const Number& t) const
  {
    return (this->node[axis] - ToFloat(this->cell[axis])) + t * this->way[axis];
  }

  /// Crosses all faces that the path meets at `first`.
  LIMPID_HD LIMPID_INLINE void Cross(const Number& first)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto stays = this->face[axis] > first;
      this->cell[axis] = this->cell[axis] + Select(stays, Whole(0), this->onward[axis]);
      this->face[axis] = Select(stays, this->face[axis], this->FaceOf(axis, this->cell[axis]));
    }
  }
};
}

#endif
