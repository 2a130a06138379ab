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
/// `most`: upper bound of the values; `piece`: see CoarseScene.
std::vector<float> Restricted(const PreparedScene& scene, const float* field, float most,
  const Grid& grid, const ScenePiece* piece)
{
  std::vector<float> coarse = piece
    ? ResampledIn(scene.Piece(), scene.Nodes(), field, grid, piece->boxes)
    : ResampledForAll(scene.Piece(), scene.Nodes(), field, grid);
  // Rounding may make a mean exceed the bound.
  ParallelFor(static_cast<Index>(coarse.size()), 65536,
    [&coarse, most](Index node)
    {
      float& value = coarse[std::size_t(node)];
      value = std::min(value, most);
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

CoarseScene::CoarseScene(const std::shared_ptr<PreparedScene>& fine, ImportanceSmoothing smoothing,
  const Grid& grid, std::shared_ptr<const ScenePiece> piece)
{
  if (fine->Piece().IsWhole() && grid.nodes == fine->Nodes().nodes)
  {
    this->Scene = fine;
    return;
  }
  SceneFields fields = fine->Arrays();
  fields.grid = grid;
  fields.piece = piece;
  fields.majorant = fine->Majorant();
  fields.despeckled =
    smoothing == ImportanceSmoothing::Median ? fine->ImportanceFor(smoothing) : nullptr;
  fields.ForEachField(
    [&](const float*& field, float most)
    {
      if (fine->Piece().ranks->AnyOf(field != nullptr)) // an empty subdomain has none
      {
        this->Values.push_back(Restricted(*fine, field, most, grid, piece.get()));
        field = this->Values.back().data();
      }
    });
  this->Scene = std::make_shared<PreparedScene>(fields);
}

std::vector<float> CoarseScene::Resampled(const PreparedScene& fine, const float* field) const
{
  return ResampledIn(
    fine.Piece(), fine.Nodes(), field, this->Scene->Nodes(), this->Scene->Piece().boxes);
}

bool CoarseScene::Supports(ImportanceSmoothing smoothing) const
{
  return smoothing == ImportanceSmoothing::Off || this->Values.empty() ||
    this->Scene->Arrays().despeckled;
}
}
