// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/CoarseFields.h"

#include "energy/Despeckle.h"
#include "scene/NodeValues.h"
#include "scene/Resampling.h"

#include <algorithm>
#include <iterator>

namespace limpid
{
namespace
{
/// Appends a field of layers on a coarser grid; rounding may make a mean exceed `most`.
void Append(const GridFilter& filter, const float* field, const NodeBox& box, float most,
  std::vector<float>& values)
{
  const std::vector<float> part = ResampledBox(filter, field, box);
  std::transform(part.begin(), part.end(), std::back_inserter(values),
    [most](float value) { return std::min(value, most); });
}
}

SceneFields CoarseFields::Scene() const
{
  SceneFields scene;
  scene.grid = this->grid;
  scene.baseExtinction = this->baseExtinction.data();
  scene.importance = this->importance.data();
  scene.despeckled = this->despeckled.empty() ? nullptr : this->despeckled.data();
  return scene;
}

CoarseFields MakeCoarseFields(const Grid& data, const Grid& coarse, ImportanceSmoothing smoothing,
  const FieldsOfLayers& ofLayers, Index nodesAtATime)
{
  const bool despeckles = smoothing == ImportanceSmoothing::Median;
  const GridFilter filter(data.nodes, coarse.nodes);
  const Index perLayer = Index(data.nodes.x) * data.nodes.y;
  const int factor = std::max(data.nodes.z / coarse.nodes.z, 1);
  const int atATime = static_cast<int>(std::max<Index>(nodesAtATime / (perLayer * factor), 1));
  CoarseFields made;
  made.grid = coarse;
  const auto count = std::size_t(coarse.NodeCount());
  made.baseExtinction.reserve(count);
  made.importance.reserve(count);
  made.despeckled.reserve(despeckles ? count : 0);
  std::vector<float> base;
  std::vector<float> importance;
  for (int begin = 0; begin < coarse.nodes.z; begin += atATime)
  {
    NodeBox box = NodeBox::Of(coarse.nodes);
    box.along[2] = { begin, std::min(begin + atATime, coarse.nodes.z) };
    const Range<int> sources = filter.SourcesOf(box).along[2];
    const Range<int> layers = Grown(sources, despeckles ? 1 : 0, data.nodes.z);
    const Index nodes = perLayer * layers.Length();
    const Index offset = perLayer * (sources.begin - layers.begin);
    base.resize(std::size_t(nodes));
    importance.resize(std::size_t(nodes));
    ofLayers(layers, base.data(), importance.data());
    Append(filter, base.data() + offset, box, mostExtinction, made.baseExtinction);
    Append(filter, importance.data() + offset, box, 1.0f, made.importance);
    if (despeckles)
    {
      Grid here = data;
      here.nodes.z = layers.Length();
      NodeValues values(nodes);
      Despeckle(here, base.data(), importance.data(), values.Data());
      Append(filter, values.Data() + offset, box, 1.0f, made.despeckled);
    }
  }
  return made;
}
}
