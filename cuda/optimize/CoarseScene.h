// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_CoarseScene_h
#define limpid_optimize_CoarseScene_h

#include "optimize/PreparedScene.h"

#include <memory>
#include <vector>

namespace limpid
{
/// Returns the grids for previews of a scene, finest first. Every process that shares the scene can
/// hold all of each.
std::vector<Grid> GridsForPreviews(const PreparedScene& scene);

/// A scene on a coarser grid: one of its previews, or the control grid.
class CoarseScene
{
public:
  /// `piece`: the decomposition of the grid; null: every process has all nodes. Collective.
  CoarseScene(const std::shared_ptr<PreparedScene>& fine, ImportanceSmoothing smoothing,
    const Grid& grid, std::shared_ptr<const ScenePiece> piece = nullptr);

  /// Whether it can be used with a filter of the importance. Specks are identified at full
  /// resolution.
  bool Supports(ImportanceSmoothing smoothing) const;

  const std::shared_ptr<PreparedScene>& Prepared() const { return this->Scene; }

  /// Returns a field of the fine scene at the nodes of this one's arrays. Collective.
  std::vector<float> Resampled(const PreparedScene& fine, const float* field) const;

private:
  std::vector<std::vector<float>> Values; ///< of its fields; none if it has those of the fine scene
  std::shared_ptr<PreparedScene> Scene;   ///< the fine one if it has the same grid
};
}

#endif
