// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/SceneStructures.h"

#include "backend/Backend.h"
#include "scene/FieldView.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace limpid
{
namespace
{
/// Adds shares of a camera, divided by the number of cameras.
void Add(std::vector<StructureShares>& mean, const std::vector<StructureShares>& some, double part)
{
  mean.resize(some.size());
  for (std::size_t i = 0; i < some.size(); ++i)
  {
    mean[i].important += part * some[i].important;
    mean[i].visible += part * some[i].visible;
    mean[i].baseVisible += part * some[i].baseVisible;
    mean[i].removed += part * some[i].removed;
    mean[i].attainable += part * some[i].attainable;
    mean[i].hiddenBy.resize(some[i].hiddenBy.size());
    for (std::size_t by = 0; by < some[i].hiddenBy.size(); ++by)
    {
      mean[i].hiddenBy[by] += part * some[i].hiddenBy[by];
    }
  }
}
}

void FillImportance(
  const Structures& structures, const StructureRow* rows, Index count, float* importance)
{
  ParallelFor(count, 65536,
    [&](Index node)
    { importance[node] = static_cast<float>(structures.ImportanceOf(rows[node])); });
}

std::vector<StructureRow> RowsOn(const ScenePiece& piece, const Grid& from,
  const StructureRow* rows, const ScenePiece& wanted, const Grid& to)
{
  const NodeBox& here = piece.nodes;
  const Int3 size = here.Size();
  std::array<std::vector<Index>, 3> nearest; // from the first node here, for each node there
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Range<int>& along = here.along[axis];
    const double ratio = double(from.nodes[int(axis)] - 1) / std::max(to.nodes[int(axis)] - 1, 1);
    for (int node = wanted.nodes.along[axis].begin; node < wanted.nodes.along[axis].end; ++node)
    {
      const int closest = static_cast<int>(std::lround(node * ratio));
      nearest[axis].push_back(std::clamp(closest, along.begin, along.end - 1) - along.begin);
    }
  }
  const Int3 nodes = wanted.nodes.Size();
  std::vector<StructureRow> found(std::size_t(wanted.nodes.Count()));
  ParallelFor(found.empty() ? 0 : nodes.z,
    [&](Index k)
    {
      StructureRow* out = found.data() + k * nodes.y * nodes.x;
      for (const Index row : nearest[1])
      {
        const StructureRow* line = rows + (nearest[2][std::size_t(k)] * size.y + row) * size.x;
        out = std::transform(
          nearest[0].begin(), nearest[0].end(), out, [line](Index column) { return line[column]; });
      }
    });
  return found;
}

std::vector<StructureShares> SharesOfStructures(PreparedScene& scene, const Camera& camera,
  const Light& light, const Settings& settings, const Structures& structures,
  const StructureRow* rows, const float* extinction)
{
  const Problem scored = scene.ProblemForScores(camera, light, settings);
  const StructureLedger ledger(
    scored.grid, scene.Arrays().piece, structures, rows, scored.baseExtinction);
  const NodeValues bound = scene.LeastExtinction(settings);
  const float* least = settings.protectImportance > 0 ? There(bound.Data()) : nullptr;
  const StructureLedger::Sampling sampling{ scored.settings.rayDensity, scored.fine };
  std::vector<const RaySource*> cameras;
  for (const TermSource& source : scored.sources)
  {
    if (source.kind == SourceKind::Camera)
    {
      cameras.push_back(&source.rays);
    }
  }
  std::vector<StructureShares> mean;
  for (const RaySource* rays : cameras)
  {
    Add(mean, ledger.SharesFrom(*rays, sampling, There(extinction), least),
      1 / double(cameras.size()));
  }
  return mean;
}
}
