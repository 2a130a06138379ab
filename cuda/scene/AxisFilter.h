// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Resampling of fields to coarser or finer grids over the same box, axis by axis, on any device.

#ifndef limpid_scene_AxisFilter_h
#define limpid_scene_AxisFilter_h

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
/// A filter along one axis: every target node is a weighted mean of consecutive source nodes.
struct AxisFilter
{
  std::vector<int> first;     ///< [target node]: first source node
  std::vector<int> begin;     ///< [target node], and one more: index of its first weight
  std::vector<float> weights; ///< sum to 1 for each target node

  /// Builds hat functions centred at the `to` target nodes, as wide as the coarser of both
  /// spacings.
  AxisFilter(int from, int to);

  /// Returns the source nodes that contribute to a range of target nodes.
  Range<int> SourcesOf(const Range<int>& nodes) const;

  /// Returns the filter for a range of target nodes, relative to SourcesOf that range.
  AxisFilter PartOf(const Range<int>& nodes) const;
};

/// A filter from one grid to another over the same box, axis by axis.
struct GridFilter
{
  Int3 from;
  Int3 to;
  std::array<std::optional<AxisFilter>, 3> along; ///< empty if the nodes do not change

  GridFilter(const Int3& from, const Int3& to);

  /// Returns the source nodes that contribute to a box of target nodes.
  NodeBox SourcesOf(const NodeBox& nodes) const;

  /// Returns the filter for a box of target nodes, relative to SourcesOf that box.
  GridFilter PartOf(const NodeBox& nodes) const;
};

/// Computes one node of a field that is filtered along an axis, see AxisFilter.
struct FilteredNode
{
  const int* first;
  const int* begin;
  const float* weights;
  int axis;
  Int3 from; ///< size of the source grid
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

/// Restricts or prolongs a field (Resampling.h) on a device that holds both fields. Asynchronous.
template <class AnyDevice>
void Resample(const std::shared_ptr<AnyDevice>& device, const GridFilter& filter,
  const float* field, float* result)
{
  const char* what = "a field on another grid";
  Int3 nodes = filter.from;
  DeviceArray<AnyDevice, float> before; // holds `field` from the second filtered axis on
  int left = 0;                         // number of axes still to be filtered
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

/// Resamples a whole field from one grid to another.
template <class AnyDevice>
void Resample(const std::shared_ptr<AnyDevice>& device, const Grid& from, const float* field,
  const Grid& to, float* result)
{
  Resample(device, GridFilter(from.nodes, to.nodes), field, result);
}
}

#endif
