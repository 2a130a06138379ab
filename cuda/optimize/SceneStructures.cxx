// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/SceneStructures.h"

#include "backend/Backend.h"
#include "scene/FieldView.h"

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
