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

/// A scene on a grid of its previews, of which every process has all nodes.
class CoarseScene
{
public:
  CoarseScene(
    const std::shared_ptr<PreparedScene>& fine, ImportanceSmoothing smoothing, const Grid& grid);

  /// Whether it can be used with a filter of the importance. Specks are identified at full
  /// resolution.
  bool Supports(ImportanceSmoothing smoothing) const;

  const std::shared_ptr<PreparedScene>& Prepared() const { return this->Scene; }

private:
  std::vector<std::vector<float>> Values; ///< of its fields; none if it has those of the fine scene
  std::shared_ptr<PreparedScene> Scene;   ///< the fine one if it has the same grid
};
}

#endif
