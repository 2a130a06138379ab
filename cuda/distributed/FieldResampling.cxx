// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "distributed/FieldResampling.h"

#include "backend/HostDevice.h"
#include "distributed/ExchangePlan.h"
#include "distributed/Neighbourhood.h"

#include <algorithm>

namespace limpid
{
std::vector<float> ResampledIn(const ScenePiece& piece, const Grid& from, const float* field,
  const Grid& to, const std::vector<NodeBox>& wanted)
{
  const GridFilter filter(from.nodes, to.nodes);
  std::vector<NodeBox> sources;
  sources.reserve(wanted.size());
  for (const NodeBox& box : wanted)
  {
    sources.push_back(filter.SourcesOf(box));
  }
  const FieldInBox values = FieldIn(piece, sources, field);
  return ResampledBox(filter, values.Data(), wanted[std::size_t(piece.ranks->Rank())]);
}

void ResampleForAll(
  const ScenePiece& piece, const Grid& from, const float* field, const Grid& to, float* result)
{
  if (piece.IsWhole())
  {
    Resample(HostDevice::Shared(), from, field, to, result);
    return;
  }
  const ScenePiece slabs = ScenePiece::Slabs(piece.ranks, to);
  std::vector<float> own = ResampledIn(piece, from, field, to, slabs.boxes);
  Spread(*piece.ranks, FieldView::Part(own.data(), slabs.nodes), RegionsOf(slabs.boxes),
    FieldView::Whole(result, to.nodes),
    std::vector<Region>(slabs.boxes.size(), { NodeBox::Of(to.nodes) }));
}

std::vector<float> ResampledForAll(
  const ScenePiece& piece, const Grid& from, const float* field, const Grid& to)
{
  std::vector<float> all(std::size_t(to.NodeCount()));
  ResampleForAll(piece, from, field, to, all.data());
  return all;
}

bool IsForAll(const Communicator& ranks, const Grid& grid, const Grid& full)
{
  constexpr Index few = 1 << 18; // grids this small may always be held completely
  return ranks.IsAlone() ||
    grid.NodeCount() <= std::max(full.NodeCount() / (4 * Index(ranks.Size())), few);
}
}
