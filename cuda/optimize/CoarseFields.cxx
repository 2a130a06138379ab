// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/CoarseFields.h"

#include "energy/Despeckle.h"
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

Index NodesAtATime(const Grid& data)
{
  constexpr Index fewest = 1 << 18;
  constexpr Index most = 1 << 22;
  return std::clamp(data.NodeCount() / 32, fewest, most);
}

SceneLayers::SceneLayers(const Grid& data, bool despeckles, const FieldsOfBox& ofBox)
  : Data(data)
  , Despeckles(despeckles)
  , OfBox(&ofBox)
{
}

void SceneLayers::MoveTo(const Range<int>& layers)
{
  NodeBox box = NodeBox::Of(this->Data.nodes);
  Range<int>& read = box.along[2];
  read = Grown(layers, this->Despeckles ? 1 : 0, this->Data.nodes.z);
  const Index nodes = box.Count();
  this->Offset = this->PerLayer() * (layers.begin - read.begin);
  this->Base.resize(std::size_t(nodes));
  this->Given.resize(std::size_t(nodes));
  (*this->OfBox)(box, this->Base.data(), this->Given.data());
  if (this->Despeckles)
  {
    Grid here = this->Data;
    here.nodes.z = read.Length();
    this->Smooth = NodeValues(nodes);
    Despeckle(here, this->Base.data(), this->Given.data(), this->Smooth.Data());
  }
}

CoarseFields MakeCoarseFields(const Grid& data, const Grid& coarse, ImportanceSmoothing smoothing,
  const FieldsOfBox& ofBox, Index nodesAtATime)
{
  const bool despeckles = smoothing == ImportanceSmoothing::Median;
  const GridFilter filter(data.nodes, coarse.nodes);
  SceneLayers fine(data, despeckles, ofBox);
  const int factor = std::max(data.nodes.z / coarse.nodes.z, 1);
  const int atATime =
    static_cast<int>(std::max<Index>(nodesAtATime / (fine.PerLayer() * factor), 1));
  CoarseFields made;
  made.grid = coarse;
  const auto count = std::size_t(coarse.NodeCount());
  made.baseExtinction.reserve(count);
  made.importance.reserve(count);
  made.despeckled.reserve(despeckles ? count : 0);
  for (int begin = 0; begin < coarse.nodes.z; begin += atATime)
  {
    NodeBox box = NodeBox::Of(coarse.nodes);
    box.along[2] = { begin, std::min(begin + atATime, coarse.nodes.z) };
    const Range<int> layers = filter.SourcesOf(box).along[2];
    fine.MoveTo(layers);
    const float* base = fine.BaseExtinction();
    made.largestExtinction = std::max(
      made.largestExtinction, *std::max_element(base, base + fine.PerLayer() * layers.Length()));
    Append(filter, base, box, mostExtinction, made.baseExtinction);
    Append(filter, fine.Importance(), box, 1.0f, made.importance);
    if (despeckles)
    {
      Append(filter, fine.Despeckled(), box, 1.0f, made.despeckled);
    }
  }
  return made;
}
}
