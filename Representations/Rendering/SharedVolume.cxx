// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SharedVolume.h"

#include "Memory.h"
#include "SceneConversion.h"
#include "SharedImage.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkUnsignedShortArray.h"

#include "distributed/ExchangePlan.h"
#include "scene/FieldView.h"
#include "scene/Structures.h"

#include <algorithm>

namespace limpid
{
namespace
{
// See Renderer::SetScalars.
constexpr int layers = 2 + static_cast<int>(farthestShared);
}

SharedVolume::SharedVolume(
  std::shared_ptr<const Communicator> ranks, vtkImageData* input, const std::array<int, 6>& whole)
{
  const SharedImage shared(std::move(ranks), input, whole);
  this->HerePiece = shared.piece;
  this->Part = { shared.grid, Grown(*shared.piece, shared.grid, layers) };
  this->Image = shared.image;
}

vtkImageData* SharedVolume::Here() const
{
  return this->Image;
}

void SharedVolume::Extend(const float* field, float* extended) const
{
  const ScenePiece& here = *this->HerePiece;
  const ScenePiece& drawn = *this->Part.Piece();
  Spread(*here.ranks, FieldView::Part(const_cast<float*>(field), here.nodes), RegionsOf(here.owned),
    FieldView::Part(extended, drawn.nodes), RegionsOf(drawn.boxes));
}

vtkSmartPointer<vtkFloatArray> SharedVolume::Extended(vtkFloatArray* field, float otherwise) const
{
  const Index count = this->Part.Nodes().NodeCount();
  auto extended = NewArray<vtkFloatArray>(field->GetName(), count);
  float* values = extended->GetPointer(0);
  std::fill(values, values + count, otherwise);
  this->Extend(field->GetPointer(0), values);
  return extended;
}

std::vector<float> SharedVolume::Extended(const std::vector<float>& shares) const
{
  if (!this->Part.AnyOf(!shares.empty()))
  {
    return {};
  }
  const std::vector<float> all(std::size_t(this->HerePiece->nodes.Count()), 1.0F);
  std::vector<float> extended(std::size_t(this->Part.Nodes().NodeCount()), 1.0F);
  this->Extend(shares.empty() ? all.data() : shares.data(), extended.data());
  return extended;
}

vtkSmartPointer<vtkUnsignedShortArray> SharedVolume::Extended(vtkUnsignedShortArray* rows) const
{
  const StructureRow* first = rows->GetPointer(0);
  const std::vector<float> here(first, first + rows->GetNumberOfValues());
  std::vector<float> numbers(std::size_t(this->Part.Nodes().NodeCount()), 0.0F);
  this->Extend(here.data(), numbers.data());
  auto extended = NewArray<vtkUnsignedShortArray>(rows->GetName(), this->Part.Nodes().NodeCount());
  std::transform(numbers.begin(), numbers.end(), extended->GetPointer(0),
    [](float number) { return static_cast<StructureRow>(number); });
  return extended;
}
}
