// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/GatheredOverlay.h"

#include "distributed/ExchangePlan.h"
#include "scene/FieldView.h"

#include <algorithm>
#include <array>

namespace limpid
{
namespace
{
constexpr std::size_t numbers = 2; // numbers per node

/// Returns those nodes of an axis whose nearest nodes among `count` others over the same length are
/// in a range.
Range<int> NearestTo(const Range<int>& others, int count, int nodes)
{
  const auto isBefore = [=](int node, int end)
  {
    // node (count - 1) / (nodes - 1) + 1 / 2 < end
    const Index cells = std::max(nodes - 1, 1);
    return 2 * Index(node) * (count - 1) + cells < 2 * Index(end) * cells;
  };
  Range<int> range{ 0, 0 };
  for (int node = 0; node < nodes; ++node)
  {
    range.begin += isBefore(node, others.begin) ? 1 : 0;
    range.end += isBefore(node, others.end) ? 1 : 0;
  }
  return range;
}

NodeBox NearestTo(const NodeBox& owned, const Int3& whole, const Int3& nodes)
{
  NodeBox box;
  for (int axis = 0; axis < 3 && !owned.Empty(); ++axis)
  {
    const auto along = std::size_t(axis);
    box.along[along] = NearestTo(owned.along[along], whole[axis], nodes[axis]);
  }
  return box;
}
}

std::vector<TwoPacked> GatheredOverlay(const DrawnPart& drawn, const Grid& grid,
  const std::function<std::vector<TwoPacked>(const Grid& some)>& resample)
{
  const ScenePiece& piece = *drawn.Piece();
  const Communicator& ranks = *piece.ranks;
  std::vector<NodeBox> boxes;
  for (const NodeBox& owned : piece.owned)
  {
    boxes.push_back(NearestTo(owned, drawn.Whole().nodes, grid.nodes));
  }
  const NodeBox& own = boxes[std::size_t(ranks.Rank())];
  const std::vector<TwoPacked> here =
    own.Empty() ? std::vector<TwoPacked>() : resample(GridOf(own, grid));
  const auto count = std::size_t(grid.NodeCount());
  std::vector<TwoPacked> all(count, TwoPacked{ { std::int16_t(packedOne), 0 } });
  std::array<std::vector<float>, numbers> sent;
  std::array<std::vector<float>, numbers> received;
  std::vector<ExchangePlan::Field> fields;
  for (std::size_t number = 0; number < numbers; ++number)
  {
    for (const TwoPacked& node : here)
    {
      sent[number].push_back(node.values[number]);
    }
    received[number].assign(count, all.front().values[number]);
    fields.push_back({ FieldView::Part(sent[number].data(), own),
      FieldView::Whole(received[number].data(), grid.nodes) });
  }
  const ExchangePlan toAll(
    ranks, RegionsOf(boxes), std::vector<Region>(boxes.size(), { NodeBox::Of(grid.nodes) }));
  toAll.Bring(fields);
  for (std::size_t node = 0; node < count; ++node)
  {
    for (std::size_t number = 0; number < numbers; ++number)
    {
      all[node].values[number] = static_cast<std::int16_t>(received[number][node]);
    }
  }
  return all;
}
}
