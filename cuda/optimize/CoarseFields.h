// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_CoarseFields_h
#define limpid_optimize_CoarseFields_h

#include "math/Range.h"
#include "optimize/SceneFields.h"

#include <functional>
#include <vector>

namespace limpid
{
/// Writes base extinction and importance of a range of layers of nodes along the third axis, first
/// axis fastest: finite values, see SceneFields.
using FieldsOfLayers =
  std::function<void(const Range<int>& layers, float* baseExtinction, float* importance)>;

/// The fields of a scene on a coarser grid over the same box.
struct CoarseFields
{
  Grid grid;
  std::vector<float> baseExtinction;
  std::vector<float> importance;
  std::vector<float> despeckled; ///< see ImportanceSmoothing; empty: not wanted

  /// Returns them as a scene, which does not own them.
  SceneFields Scene() const;
};

/// Resamples a scene to a coarser grid, a few layers at a time, so that only these are in memory.
/// The values are those of a CoarseScene. A process alone only. `nodesAtATime`: about as many nodes
/// of the data are in memory.
CoarseFields MakeCoarseFields(const Grid& data, const Grid& coarse, ImportanceSmoothing smoothing,
  const FieldsOfLayers& ofLayers, Index nodesAtATime = 1 << 22);
}

#endif
