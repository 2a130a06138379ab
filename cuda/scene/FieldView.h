// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Fields in parts: boxes of nodes, and views of the fields that have values there.

#ifndef limpid_scene_FieldView_h
#define limpid_scene_FieldView_h

#include "scene/NodeBox.h"
#include "scene/Occupancy.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace limpid
{
/// A set of nodes of a grid, given as boxes, which may overlap.
using Region = std::vector<NodeBox>;

/// Returns one region per box.
std::vector<Region> RegionsOf(const std::vector<NodeBox>& boxes);

/// Returns the part of a region inside a box.
Region Intersection(const Region& region, const NodeBox& box);

/// A strided field: the value of node (i, j, k) is values[i stride.x + j stride.y + k stride.z].
struct FieldView
{
  float* values;
  std::array<Index, 3> stride;

  /// View of a field that holds all nodes of a grid.
  static FieldView Whole(float* values, const Int3& nodes)
  {
    return { values, { { 1, nodes.x, Index(nodes.x) * nodes.y } } };
  }

  /// View of a field that holds only the nodes of a box.
  static FieldView Part(float* values, const NodeBox& box)
  {
    FieldView view = Whole(values, box.Size());
    if (!box.Empty()) // otherwise `values` may be null
    {
      view.values -= view.At(box.along[0].begin, box.along[1].begin, box.along[2].begin);
    }
    return view;
  }

  Index At(int i, int j, int k) const
  {
    return i * this->stride[0] + j * this->stride[1] + k * this->stride[2];
  }

  /// Whether every node has the same address in both. The origins alone do not tell: a view of a
  /// part may have its origin, which it does not contain, anywhere, even at that of another field.
  bool IsSameAs(const FieldView& other) const
  {
    return this->values == other.values && this->stride == other.stride;
  }
};

/// Calls what(first node of a row, count) for the filled parts of the rows of a box. `axis`:
/// direction of the rows, 0 or 1. If `filled` is null, whole rows are visited.
template <class What>
void ForRowsOf(const NodeBox& box, const Occupancy* filled, const What& what, int axis = 0)
{
  const Range<int>& along = box.along[std::size_t(axis)];
  const Range<int>& beside = box.along[std::size_t(1 - axis)];
  for (int k = box.along[2].begin; k < box.along[2].end; ++k)
  {
    for (int number = beside.begin; number < beside.end; ++number)
    {
      const Range<int> row =
        filled ? Intersection(along, filled->Row(axis, number, k).filled) : along;
      if (!row.Empty())
      {
        what(axis == 0 ? Int3(row.begin, number, k) : Int3(number, row.begin, k), row.Length());
      }
    }
  }
}

/// The values of a row of nodes along an axis of a field.
struct RowInField
{
  float* first;
  Index stride;

  RowInField(const FieldView& field, const Int3& node, int axis = 0)
    : first(field.values + field.At(node.x, node.y, node.z))
    , stride(field.stride[std::size_t(axis)])
  {
  }

  void CopyTo(float* values, int count) const
  {
    if (this->stride == 1)
    {
      std::copy_n(this->first, count, values);
      return;
    }
    for (int i = 0; i < count; ++i)
    {
      values[i] = this->first[i * this->stride];
    }
  }

  void CopyFrom(const float* values, int count) const
  {
    if (this->stride == 1)
    {
      std::copy_n(values, count, this->first);
      return;
    }
    for (int i = 0; i < count; ++i)
    {
      this->first[i * this->stride] = values[i];
    }
  }
};

/// Returns `field`, or the address of a dummy value if it is null because the subdomain is empty.
template <class Value>
Value* There(Value* field)
{
  static float none = 0;
  return field ? field : &none;
}

/// Sets the values of a box of nodes.
void FillNodes(const NodeBox& box, float value, const FieldView& field);

/// Copies the values of a box, row by row along `axis` (0 or 1). `filled`: outside of it both
/// fields are known to be 0; null if nothing is known.
void CopyNodes(const NodeBox& box, const FieldView& from, const FieldView& to,
  const Occupancy* filled = nullptr, int axis = 0);
}

#endif
