// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SharedImage.h"

#include "SceneConversion.h"

#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include "distributed/ExchangePlan.h"
#include "scene/FieldView.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace limpid
{
namespace
{
/// Returns the grid of the whole image, by the placement of the first rank that has points.
Grid GridOfAll(const Communicator& ranks, vtkImageData* input, const std::array<int, 6>& whole)
{
  const bool hasPoints = input && input->GetNumberOfPoints() > 0;
  std::int32_t first = hasPoints ? ranks.Rank() : ranks.Size();
  ranks.TakeLeast(&first, 1);
  if (first == ranks.Size())
  {
    throw JointError("The input has no points on any rank (there is nothing to process). Give it "
                     "an image with data.");
  }
  ImagePlacement placement{};
  if (hasPoints && ranks.Rank() == first)
  {
    placement = PlacementOf(input, whole.data());
  }
  ranks.Gather(placement.data(), placement.size());
  return GridOfExtent(whole.data(), placement); // identical on all ranks
}

NodeBox BoxOf(vtkImageData* input, const std::array<int, 6>& whole)
{
  NodeBox box;
  for (std::size_t axis = 0; axis < 3 && input && input->GetNumberOfPoints() > 0; ++axis)
  {
    const int* extent = input->GetExtent() + 2 * axis;
    box.along[axis] = { extent[0] - whole[2 * axis], extent[1] + 1 - whole[2 * axis] };
  }
  return box;
}

/// Clears a flag in the array "vtkGhostType". The array of the input is not changed.
void TakeAway(unsigned char flag, vtkDataSetAttributes* data)
{
  auto* flags =
    vtkUnsignedCharArray::SafeDownCast(data->GetArray(vtkDataSetAttributes::GhostArrayName()));
  if (flags)
  {
    vtkNew<vtkUnsignedCharArray> others;
    others->DeepCopy(flags);
    for (vtkIdType i = 0; i < others->GetNumberOfValues(); ++i)
    {
      others->SetValue(i, static_cast<unsigned char>(others->GetValue(i) & ~flag));
    }
    data->AddArray(others);
  }
}
}

SharedImage::SharedImage(
  std::shared_ptr<const Communicator> ranks, vtkImageData* input, const std::array<int, 6>& whole)
  : grid(GridOfAll(*ranks, input, whole))
  , image(vtkSmartPointer<vtkImageData>::New())
{
  const NodeBox box = BoxOf(input, whole);
  if (!box.Empty())
  {
    this->image->ShallowCopy(input);
    TakeAway(vtkDataSetAttributes::DUPLICATEPOINT, this->image->GetPointData());
    TakeAway(vtkDataSetAttributes::DUPLICATECELL, this->image->GetCellData());
  }
  this->piece = std::make_shared<const ScenePiece>(std::move(ranks), this->grid, box);
}

void SharedImage::CopyFromOwners(vtkFloatArray* field) const
{
  const FieldView view = FieldView::Part(field->GetPointer(0), this->piece->nodes);
  Spread(
    *this->piece->ranks, view, RegionsOf(this->piece->owned), view, RegionsOf(this->piece->boxes));
}

void JoinRange(const Communicator& ranks, double& low, double& high)
{
  std::vector<double> ends(2 * std::size_t(ranks.Size()), 0.0);
  const auto own = 2 * std::size_t(ranks.Rank());
  ends[own] = low;
  ends[own + 1] = high;
  ranks.Gather(ends.data(), ends.size());
  low = high = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t end = 0; end < ends.size(); end += 2)
  {
    low = std::fmin(low, ends[end]);
    high = std::fmax(high, ends[end + 1]);
  }
}
}
