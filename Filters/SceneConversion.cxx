// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SceneConversion.h"

#include "Blanking.h"
#include "Choices.h"
#include "Memory.h"
#include "StructureLabels.h"

#include "vtkCellData.h"
#include "vtkCellDataToPointData.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUniformGrid.h"
#include "vtkUnsignedCharArray.h"

#include "math/Require.h"
#include "optimize/SceneStructures.h"
#include "optimize/Solver.h"
#include "scene/ImageGrid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <sstream>
#include <vector>

namespace limpid
{
namespace
{
// Returns the chosen component of a cell array, averaged to the points. This happens before any
// mapping: transfer functions apply to the data at the points, as they do for point arrays.
vtkSmartPointer<vtkFloatArray> AverageToPoints(vtkImageData* image, const FieldSource& source)
{
  const auto cellValues = NewArray<vtkFloatArray>("value", source.array->GetNumberOfTuples());
  MapArray(source.array, source.component, KeepValue(), cellValues->GetPointer(0));

  // vtkCellDataToPointData writes ghost arrays of points, so it must not get the input itself. A
  // vtkUniformGrid takes hidden cells into account: they do not count.
  vtkNew<vtkUniformGrid> cells;
  cells->SetExtent(image->GetExtent());
  cells->GetCellData()->AddArray(cellValues);
  if (const auto hidden = Blanking(image).HiddenCells())
  {
    cells->GetCellData()->AddArray(hidden);
  }
  vtkNew<vtkCellDataToPointData> average;
  average->SetInputData(cells);
  NewArray<vtkFloatArray>("tried", image->GetNumberOfPoints()); // throws if out of memory
  average->Update();
  return vtkFloatArray::SafeDownCast(
    average->GetImageDataOutput()->GetPointData()->GetArray("value"));
}

// Returns whether all values are finite, at least zero and at most `largest`. This is the usual
// case, and the loop vectorises: such floating-point numbers are ordered like their bits as
// integers.
bool AreWithin(const float* values, vtkIdType count, float largest)
{
  std::uint32_t largestBits;
  std::memcpy(&largestBits, &largest, sizeof(largestBits));
  unsigned outside = 0;
  for (vtkIdType i = 0; i < count; ++i)
  {
    std::uint32_t bits;
    std::memcpy(&bits, values + i, sizeof(bits));
    outside |= bits > largestBits ? 1U : 0U;
  }
  return outside == 0;
}

// Makes points without a share empty.
void EmptyPoints(const std::vector<float>& shares, vtkFloatArray* field)
{
  float* values = field->GetPointer(0);
  std::transform(shares.begin(), shares.end(), values, values,
    [](float share, float value) { return share > 0 ? value : 0.0F; });
}

// Makes unusable points empty, and clamps importance to [0, 1].
void CorrectPoints(vtkIdType count, float* extinction, float* importance, UnusablePoints& found)
{
  constexpr float largest = std::numeric_limits<float>::max();
  if (AreWithin(extinction, count, largest) && AreWithin(importance, count, 1))
  {
    return;
  }
  for (vtkIdType i = 0; i < count; ++i)
  {
    const bool invalid = !(std::isfinite(extinction[i]) && std::isfinite(importance[i]));
    const bool negative = !invalid && extinction[i] < 0;
    found.invalid += invalid ? 1 : 0;
    found.negative += negative ? 1 : 0;
    if (invalid || negative)
    {
      extinction[i] = 0;
      importance[i] = 0;
    }
    else if (!(importance[i] >= 0 && importance[i] <= 1))
    {
      importance[i] = std::min(std::max(importance[i], 0.0F), 1.0F);
      ++found.clamped;
    }
  }
}
}

std::string UnusablePoints::Warning(vtkIdType all) const
{
  std::ostringstream text;
  const auto report = [all, &text](vtkIdType points, const char* what)
  {
    if (points > 0)
    {
      text << (text.tellp() > 0 ? " " : "") << points << " of " << all << " points have " << what;
    }
  };
  report(this->invalid,
    "a NaN or an infinite value (the scene is undefined there) and are treated as empty. Replace "
    "these values if they should count.");
  report(this->negative,
    "a negative extinction (it would amplify light) and are treated as empty. Give an extinction "
    "of zero or more.");
  report(this->clamped,
    "an importance outside [0, 1] (the energy is not defined there) and are clamped to this range. "
    "Map the values to importance with ImportanceFunction.");
  return text.str();
}

Grid GridOfImage(vtkImageData* image)
{
  int extent[6];
  image->GetExtent(extent);
  return GridOfExtent(extent, PlacementOf(image, extent));
}

ImagePlacement PlacementOf(vtkImageData* image, const int extent[6])
{
  ImagePlacement placement{};
  image->TransformIndexToPhysicalPoint(extent[0], extent[2], extent[4], placement.data());
  std::copy_n(image->GetSpacing(), 3, placement.begin() + 3);
  std::copy_n(image->GetDirectionMatrix()->GetData(), 9, placement.begin() + 6);
  return placement;
}

Grid GridOfExtent(const int extent[6], const ImagePlacement& placement)
{
  Grid placed;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto at = static_cast<std::size_t>(axis);
    placed.nodes[axis] = std::max(0, extent[2 * axis + 1] - extent[2 * axis] + 1);
    placed.origin[axis] = placement[at];
    placed.spacing[axis] = placement[3 + at];
    for (int row = 0; row < 3; ++row)
    {
      placed.direction[axis][row] = placement[6 + 3 * std::size_t(row) + at];
    }
  }
  return ImageGrid(placed.nodes, placed.origin, placed.spacing, placed.direction);
}

void SetReferences(const References& references, SceneFields& scene)
{
  std::transform(references.begin(), references.end(), scene.references.begin(),
    [](vtkFloatArray* array) { return array ? array->GetPointer(0) : nullptr; });
}

void RequireOneEach(vtkImageData* image, const FieldSource& source)
{
  const vtkIdType expected =
    source.onCells ? image->GetNumberOfCells() : image->GetNumberOfPoints();
  LIMPID_REQUIRE(source.array->GetNumberOfTuples() == expected,
    "The array \""
      << NameOf(source.array) << "\" has " << source.array->GetNumberOfTuples() << " values for "
      << expected << (source.onCells ? " cells" : " points")
      << " (values cannot be assigned to positions). Give an array with one value for each.");
}

vtkSmartPointer<vtkFloatArray> ConvertField(
  vtkImageData* image, const FieldSource& source, const char* name)
{
  auto field = NewArray<vtkFloatArray>(name, image->GetNumberOfPoints());
  RequireOneEach(image, source);

  if (source.onCells)
  {
    const vtkSmartPointer<vtkFloatArray> averaged = AverageToPoints(image, source);
    MapArray(averaged, MagnitudeComponent, source.mapping, field->GetPointer(0));
  }
  else
  {
    MapArray(source.array, source.component, source.mapping, field->GetPointer(0));
  }
  return field;
}

void TakeShares(const std::vector<float>& shares, vtkFloatArray* field)
{
  float* values = field->GetPointer(0);
  std::transform(shares.begin(), shares.end(), values, values,
    [](float share, float value) { return share * value; });
}

void ConvertImportance(vtkImageData* image, const FieldSource& source, SceneArrays& arrays)
{
  if (!source.structures)
  {
    arrays.importance = ConvertField(image, source, "Importance");
    return;
  }
  RequireOneEach(image, source);
  arrays.structureRows = RowsAtPoints(image, source);
  arrays.importance = NewArray<vtkFloatArray>("Importance", image->GetNumberOfPoints());
  FillImportance(*source.structures, arrays.structureRows->GetPointer(0),
    image->GetNumberOfPoints(), arrays.importance->GetPointer(0));
}

SceneArrays ConvertScene(
  vtkImageData* image, const FieldSource& extinction, const FieldSource& importance)
{
  SceneArrays arrays;
  arrays.baseExtinction = ConvertField(image, extinction, "BaseExtinction");
  ConvertImportance(image, importance, arrays);
  const Blanking blanking(image);
  const std::vector<float> ofExtinction = blanking.Shares(extinction.onCells);
  const std::vector<float> ofImportance = blanking.Shares(importance.onCells);
  EmptyPoints(ofExtinction, arrays.baseExtinction);
  EmptyPoints(ofImportance, arrays.importance);
  CorrectPoints(arrays.baseExtinction->GetNumberOfTuples(), arrays.baseExtinction->GetPointer(0),
    arrays.importance->GetPointer(0), arrays.unusable);
  TakeShares(ofExtinction, arrays.baseExtinction);
  TakeShares(ofImportance, arrays.importance);
  return arrays;
}

bool LayeredFields::Suit(
  vtkImageData* image, const FieldSource& extinction, const FieldSource& importance)
{
  const Blanking blanking(image);
  return blanking.MTime() == 0 && !importance.structures && !extinction.onCells &&
    !importance.onCells;
}

LayeredFields::LayeredFields(
  vtkImageData* image, const FieldSource& extinction, const FieldSource& importance)
  : Points(GridOfImage(image).nodes)
  , Extinction(extinction.array, extinction.component, extinction.mapping)
  , Importance(importance.array, importance.component, importance.mapping)
{
  RequireOneEach(image, extinction);
  RequireOneEach(image, importance);
}

void LayeredFields::Fill(const NodeBox& box, float* baseExtinction, float* importance)
{
  const Int3 size = box.Size();
  const bool isWhole = size.x == this->Points.x && size.y == this->Points.y;
  const Range<int>& layers = box.along[2];
  const int seen = isWhole ? std::min(std::max(this->Seen, layers.begin), layers.end) : layers.end;
  NodeBox before = box;
  before.along[2].end = seen;
  NodeBox behind = box;
  behind.along[2].begin = seen;
  UnusablePoints again; // have been counted, or will be
  this->Convert(before, baseExtinction, importance, again);
  this->Convert(behind, baseExtinction + before.Count(), importance + before.Count(), this->Found);
  this->Seen = isWhole ? std::max(this->Seen, layers.end) : this->Seen;
}

void LayeredFields::Convert(
  const NodeBox& box, float* baseExtinction, float* importance, UnusablePoints& found)
{
  if (box.Empty())
  {
    return;
  }
  const Int3 first = box.First();
  const Int3 size = box.Size();
  const vtkIdType perLayer = vtkIdType(this->Points.x) * this->Points.y;
  const TupleBox tuples{ first.x + first.y * vtkIdType(this->Points.x) + first.z * perLayer, size.x,
    size.y, size.z, this->Points.x, perLayer };
  this->Extinction.Fill(tuples, baseExtinction);
  this->Importance.Fill(tuples, importance);
  CorrectPoints(box.Count(), baseExtinction, importance, found);
}
}
