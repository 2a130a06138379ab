// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_CoarseFields_h
#define limpid_optimize_CoarseFields_h

#include "math/Range.h"
#include "optimize/SceneFields.h"
#include "scene/NodeBox.h"
#include "scene/NodeValues.h"

#include <functional>
#include <vector>

namespace limpid
{
/// Returns about how many nodes of the data are in memory where a few layers are made at a time:
/// few of all, and as many as keep the processors busy.
Index NodesAtATime(const Grid& data);

/// Writes base extinction and importance of a box of nodes, first axis fastest: finite values, see
/// SceneFields.
using FieldsOfBox =
  std::function<void(const NodeBox& box, float* baseExtinction, float* importance)>;

/// The fields of some layers of a scene.
class SceneLayers
{
public:
  /// `despeckles`: whether the despeckled importance is wanted, too.
  SceneLayers(const Grid& data, bool despeckles, const FieldsOfBox& ofBox);

  /// Makes the fields of a range of layers.
  void MoveTo(const Range<int>& layers);

  // One value per node of the layers:
  const float* BaseExtinction() const { return this->Base.data() + this->Offset; }
  const float* Importance() const { return this->Given.data() + this->Offset; }
  const float* Despeckled() const { return this->Smooth.Data() + this->Offset; }

  Index PerLayer() const { return Index(this->Data.nodes.x) * this->Data.nodes.y; }

private:
  Grid Data;
  bool Despeckles;
  const FieldsOfBox* OfBox;
  std::vector<float> Base;  ///< of these layers and those that despeckling reads
  std::vector<float> Given; ///< the importance, likewise
  NodeValues Smooth;        ///< the despeckled importance, likewise
  Index Offset = 0;         ///< of the first layer
};

/// The fields of a scene on a coarser grid over the same box.
struct CoarseFields
{
  Grid grid;
  float largestExtinction = 0; ///< of the base extinction of the data [1/length]
  std::vector<float> baseExtinction;
  std::vector<float> importance;
  std::vector<float> despeckled; ///< see ImportanceSmoothing; empty: not wanted

  /// Returns them as a scene, which does not own them.
  SceneFields Scene() const;
};

/// Resamples a scene to a coarser grid, a few layers at a time, so that only these are in memory.
/// The values are those of a CoarseScene. A process alone only. `nodesAtATime`: about as many nodes
/// of the data are in memory. `ofBox` is asked for whole layers along the third axis, in order.
CoarseFields MakeCoarseFields(const Grid& data, const Grid& coarse, ImportanceSmoothing smoothing,
  const FieldsOfBox& ofBox, Index nodesAtATime);
}

#endif
