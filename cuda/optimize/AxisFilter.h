// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Fields on coarser and finer grids over the same box, axis by axis, on any device.

#ifndef limpid_optimize_AxisFilter_h
#define limpid_optimize_AxisFilter_h

#include "backend/DeviceArray.h"
#include "backend/Simd.h"
#include "scene/Grid.h"
#include "scene/NodeBox.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace limpid
{
/// Along one axis, every node is a weighted mean of consecutive nodes of another grid.
struct AxisFilter
{
  std::vector<int> first;     ///< per node: the first of the other nodes
  std::vector<int> begin;     ///< per node, and one more: its first weight
  std::vector<float> weights; ///< with a sum of 1 per node

  /// Hat functions about the `to` nodes of the axis, as wide as the coarser of the two spacings.
  AxisFilter(int from, int to);

  /// The other nodes that some of the nodes are means of.
  Range<int> SourcesOf(const Range<int>& nodes) const;

  /// That of some of the nodes, from those other nodes alone.
  AxisFilter PartOf(const Range<int>& nodes) const;
};

/// How fields at some nodes become fields at others in the same box, axis by axis.
struct GridFilter
{
  Int3 from;
  Int3 to;
  std::array<std::optional<AxisFilter>, 3> along; ///< not there: the nodes are the same

  GridFilter(const Int3& from, const Int3& to);

  /// The nodes of the field that some nodes of the result are means of.
  NodeBox SourcesOf(const NodeBox& nodes) const;

  /// That of some nodes of the result, from those of the field alone.
  GridFilter PartOf(const NodeBox& nodes) const;
};

/// One node of a field that is filtered along an axis, see AxisFilter.
struct FilteredNode
{
  const int* first;
  const int* begin;
  const float* weights;
  int axis;
  Int3 from; ///< nodes of `field`
  const float* field;
  float* out;

  LIMPID_HD void operator()(Index node, int i, int j, int k) const
  {
    const int at = this->axis == 0 ? i : (this->axis == 1 ? j : k);
    const int source = this->first[at];
    const Index column = this->axis == 0 ? source : i;
    const Index row = this->axis == 1 ? source : j;
    const Index slice = this->axis == 2 ? source : k;
    const float* value = this->field + column + this->from.x * (row + this->from.y * slice);
    const Index stride =
      this->axis == 0 ? 1 : (this->axis == 1 ? this->from.x : Index(this->from.x) * this->from.y);
    float sum = 0;
    for (int weight = this->begin[at]; weight < this->begin[at + 1]; ++weight)
    {
      sum += this->weights[weight] * *value;
      value += stride;
    }
    this->out[node] = sum;
  }
};

/// Restrict or Prolong (Levels.h) on a device, where both fields are. Does not wait.
template <class AnyDevice>
void Resample(const std::shared_ptr<AnyDevice>& device, const GridFilter& filter,
  const float* field, float* result)
{
  const char* what = "a field on another grid";
  Int3 nodes = filter.from;
  DeviceArray<AnyDevice, float> before; // what `field` is from the second axis on
  int left = 0;                         // axes that are filtered
  for (const std::optional<AxisFilter>& along : filter.along)
  {
    left += along ? 1 : 0;
  }
  if (left == 0)
  {
    device->Copy(result, field, std::size_t(Index(nodes.x) * nodes.y * nodes.z) * sizeof(float));
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::optional<AxisFilter>& along = filter.along[std::size_t(axis)];
    if (!along)
    {
      continue;
    }
    const DeviceArray<AnyDevice, int> first(device, along->first, what);
    const DeviceArray<AnyDevice, int> begin(device, along->begin, what);
    const DeviceArray<AnyDevice, float> weights(device, along->weights, what);
    const Int3 source = nodes;
    nodes[axis] = filter.to[axis];
    DeviceArray<AnyDevice, float> after;
    float* out = --left == 0
      ? result
      : after.RoomFor(device, std::size_t(Index(nodes.x) * nodes.y * nodes.z), what);
    device->ForNodes("resample", nodes,
      FilteredNode{ first.Data(), begin.Data(), weights.Data(), axis, source, field, out });
    before = std::move(after);
    field = before.Data();
  }
}

/// The same from all nodes of a grid to all of another.
template <class AnyDevice>
void Resample(const std::shared_ptr<AnyDevice>& device, const Grid& from, const float* field,
  const Grid& to, float* result)
{
  Resample(device, GridFilter(from.nodes, to.nodes), field, result);
}
}

#endif
