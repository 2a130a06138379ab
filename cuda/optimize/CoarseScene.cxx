// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/CoarseScene.h"

#include "backend/Backend.h"
#include "distributed/FieldResampling.h"

#include <algorithm>

namespace limpid
{
namespace
{
std::vector<float> Restricted(const PreparedScene& scene, const float* field, const Grid& grid)
{
  return ResampledForAll(scene.Piece(), scene.Nodes(), field, grid);
}

std::vector<float> RestrictedImportance(
  const PreparedScene& scene, const float* importance, const Grid& grid)
{
  std::vector<float> coarse = Restricted(scene, importance, grid);
  // Rounding may make a mean of numbers up to 1 exceed 1.
  ParallelFor(grid.NodeCount(), 65536,
    [&coarse](Index node)
    {
      float& value = coarse[std::size_t(node)];
      value = std::min(value, 1.0f);
    });
  return coarse;
}
}

std::vector<Grid> GridsForPreviews(const PreparedScene& scene)
{
  const Grid& full = scene.Nodes();
  constexpr int coarsest = 32;
  std::vector<Grid> grids;
  const auto suits = [&](const Grid& grid, bool last)
  {
    return grids.empty() ? last || IsForAll(*scene.Piece().ranks, grid, full)
                         : grids.back().NodeCount() > 4096 && grid.nodes != grids.back().nodes;
  };
  for (const int factor : { 1, 2, 3, 4, 6, 8, 12, 16, 24, coarsest })
  {
    const Grid grid = factor == 1 ? full : CoarseGrid(full, factor);
    if (suits(grid, factor == coarsest))
    {
      grids.push_back(grid);
    }
  }
  return grids;
}

CoarseScene::CoarseScene(
  const std::shared_ptr<PreparedScene>& fine, ImportanceSmoothing smoothing, const Grid& grid)
{
  if (fine->Piece().IsWhole() && grid.nodes == fine->Nodes().nodes)
  {
    this->Scene = fine;
    return;
  }
  const SceneFields& from = fine->Arrays();
  this->Base = Restricted(*fine, from.baseExtinction, grid);
  this->Importance = RestrictedImportance(*fine, from.importance, grid);
  if (smoothing == ImportanceSmoothing::Median)
  {
    this->Despeckled = RestrictedImportance(*fine, fine->ImportanceFor(smoothing), grid);
  }
  this->Scene =
    std::make_shared<PreparedScene>(SceneFields{ grid, this->Base.data(), this->Importance.data(),
      from.majorant, this->Despeckled.empty() ? nullptr : this->Despeckled.data() });
}

bool CoarseScene::Supports(ImportanceSmoothing smoothing) const
{
  return smoothing == ImportanceSmoothing::Off || this->Base.empty() || !this->Despeckled.empty();
}
}
