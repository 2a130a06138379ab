// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "LabelResampling.h"

#include "AllCores.h"
#include "Choices.h"
#include "Memory.h"

#include "vtkDataArray.h"
#include "vtkIntArray.h"

#include "math/Require.h"
#include "math/Vec.h"
#include "scene/Grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

namespace limpid
{
namespace
{
// A position that is nearly between two samples counts as exactly between them [label spacings]:
// much more than rounding adds to positions, and much less than matters.
constexpr double nearTie = 1e-6;

constexpr int mostPerAxis = 8; // sub-samples
constexpr std::size_t mostSubSamples = mostPerAxis * mostPerAxis * mostPerAxis;

bool IsFloatingPoint(vtkDataArray* array)
{
  return array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
}

vtkSmartPointer<vtkDataArray> LabelsOfNumbers(vtkDataArray* array)
{
  constexpr int none = std::numeric_limits<int>::min();
  const vtkIdType count = array->GetNumberOfTuples();
  auto labels = NewArray<vtkIntArray>("Labels", count);
  int* values = labels->GetPointer(0);
  ForOnAllCores(count,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const double value = array->GetComponent(i, 0);
        const bool isLabel = value == std::floor(value) && std::abs(value) < 0x1p31;
        values[i] = isLabel ? static_cast<int>(value) : std::isnan(value) ? 0 : none;
      }
    });
  const vtkIdType wrong = std::find(values, values + count, none) - values;
  LIMPID_REQUIRE(wrong == count,
    "The label array \"" << NameOf(array) << "\" has the value " << array->GetComponent(wrong, 0)
                         << " (labels are whole numbers below 2^31; interpolation between them "
                            "makes structures up). Choose an array of labels, or set MasksToLabels "
                            "for masks.");
  return labels;
}

template <class Label>
vtkSmartPointer<vtkDataArray> NewLabels(int type, vtkIdType count)
{
  std::unique_ptr<Label[]> values(new Label[static_cast<std::size_t>(count)]);
  auto labels = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  labels->SetName("Structure");
  labels->SetVoidArray(values.release(), count, 0, vtkAbstractArray::VTK_DATA_ARRAY_DELETE);
  return labels;
}

// Where the samples of labels are, as seen from the points of an image.
struct SampleLattice
{
  SampleLattice(const Grid& image, const Grid& labelled, bool onCells);

  // Returns the position of a point of the image, from the first sample [label spacings].
  Vec3 PositionOf(const Int3& point) const { return this->origin + this->steps * Vec3(point); }

  // Returns sub-samples of the box of a point, from the point [label spacings].
  std::vector<Vec3> SubSamples() const;

  Vec3 origin; // position of point (0, 0, 0)        [label spacings]
  Mat3 steps;  // columns: from a point to the next one along each axis [label spacings]
  Int3 count;  // number of samples along each axis of the labels
};

SampleLattice::SampleLattice(const Grid& image, const Grid& labelled, bool onCells)
  : origin(labelled.PointToIndex(image.origin))
  , count(labelled.nodes)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    this->steps[axis] = labelled.DirectionToIndex(image.direction[axis] * image.spacing[axis]);
    if (onCells && this->count[axis] > 1) // there is one cell across a flat axis, at its point
    {
      this->count[axis] -= 1;
      this->origin[axis] -= 0.5;
    }
  }
}

std::vector<Vec3> SampleLattice::SubSamples() const
{
  std::array<int, 3> perAxis;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double length = glm::length(this->steps[axis]); // of the box, along the axis
    const double wanted = length < 1 - nearTie ? 1 : std::ceil(2 * length - nearTie);
    perAxis[static_cast<std::size_t>(axis)] =
      static_cast<int>(std::min(wanted, double(mostPerAxis)));
  }
  const auto offset = [&perAxis](int number, std::size_t axis)
  { return (number + 0.5) / perAxis[axis] - 0.5; };
  std::vector<Vec3> offsets;
  for (int k = 0; k < perAxis[2]; ++k)
  {
    for (int j = 0; j < perAxis[1]; ++j)
    {
      for (int i = 0; i < perAxis[0]; ++i)
      {
        offsets.push_back(this->steps * Vec3(offset(i, 0), offset(j, 1), offset(k, 2)));
      }
    }
  }
  return offsets;
}

// Returns the most frequent of some labels; of several, `preferred` or else the smallest that is
// not 0.
template <class Label>
Label MostFrequent(Label* begin, Label* end, Label preferred)
{
  std::sort(begin, end);
  Label best = 0;
  std::ptrdiff_t most = 0;
  for (Label* label = begin; label != end;)
  {
    Label* next = std::upper_bound(label, end, *label);
    const std::ptrdiff_t votes = next - label;
    const bool winsTie = *label == preferred || (best == 0 && best != preferred);
    if (votes > most || (votes == most && winsTie))
    {
      best = *label;
      most = votes;
    }
    label = next;
  }
  return best;
}

// Finds the label of one point of an image.
template <class Label>
struct PointLabel
{
  SampleLattice lattice;
  std::vector<Vec3> subSamples; // of Majority; one or none: Nearest
  const Label* labels;          // one per sample, x fastest

  // Returns the label of the sample next to a position; null: it is outside the box of the samples.
  const Label* NearestTo(const Vec3& position) const
  {
    vtkIdType sample = 0;
    for (int axis = 2; axis >= 0; --axis)
    {
      const int count = this->lattice.count[axis];
      const double fromBorder = position[axis] + 0.5 + nearTie;
      if (!(fromBorder >= 0 && fromBorder <= count + 2 * nearTie))
      {
        return nullptr;
      }
      sample = sample * count + std::min(static_cast<int>(fromBorder), count - 1);
    }
    return this->labels + sample;
  }

  Label operator()(const Int3& point) const
  {
    const Vec3 position = this->lattice.PositionOf(point);
    const Label* nearest = this->NearestTo(position);
    if (!nearest)
    {
      return 0;
    }
    std::array<Label, mostSubSamples> candidates;
    std::size_t count = 0;
    bool areEqual = true;
    for (const Vec3& offset : this->subSamples)
    {
      if (const Label* label = this->NearestTo(position + offset))
      {
        candidates[count] = *label;
        areEqual = areEqual && *label == *nearest;
        ++count;
      }
    }
    return areEqual ? *nearest
                    : MostFrequent(candidates.data(), candidates.data() + count, *nearest);
  }
};

template <class Label>
void Resample(const PointLabel<Label>& labelOf, const Int3& points, Label* result)
{
  for (int z = 0; z < points.z; ++z)
  {
    ForOnAllCores(points.y,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (auto y = static_cast<int>(begin); y < end; ++y)
        {
          Label* row = result + points.x * (y + vtkIdType(points.y) * z);
          for (int x = 0; x < points.x; ++x)
          {
            row[x] = labelOf(Int3(x, y, z));
          }
        }
      });
    Interruptible::Check(double(z + 1) / points.z);
  }
}

template <class Label>
std::map<std::int64_t, vtkIdType> CountIn(const Label* labels, vtkIdType count)
{
  constexpr vtkIdType length = 1 << 18; // of a part
  std::vector<std::map<std::int64_t, vtkIdType>> parts(
    static_cast<std::size_t>((count + length - 1) / length));
  ParallelFor(static_cast<Index>(parts.size()),
    [&](Index part)
    {
      const Label* end = labels + std::min(count, (part + 1) * length);
      for (const Label* label = labels + part * length; label != end;)
      {
        const Label here = *label;
        const Label* next = std::find_if(label, end, [here](Label other) { return other != here; });
        parts[static_cast<std::size_t>(part)][static_cast<std::int64_t>(here)] += next - label;
        label = next;
      }
    });
  std::map<std::int64_t, vtkIdType> sum;
  for (const auto& part : parts)
  {
    for (const auto& [label, times] : part)
    {
      sum[label] += times;
    }
  }
  return sum;
}
}

vtkSmartPointer<vtkDataArray> WholeLabels(vtkDataArray* array)
{
  if (IsFloatingPoint(array))
  {
    return LabelsOfNumbers(array);
  }
  const bool hasBits = array->GetDataType() == VTK_BIT; // packed, although its layout is standard
  if (array->HasStandardMemoryLayout() && !hasBits)
  {
    return array;
  }
  auto copy = vtkSmartPointer<vtkDataArray>::Take(
    vtkDataArray::CreateDataArray(hasBits ? VTK_UNSIGNED_CHAR : array->GetDataType()));
  copy->DeepCopy(array);
  return copy;
}

MaskLabels LabelsOfMasks(const std::vector<FieldSource>& masks)
{
  const vtkIdType count = masks.front().array->GetNumberOfTuples();
  const auto labels = NewArray<vtkUnsignedShortArray>("Labels", count);
  unsigned short* values = labels->GetPointer(0);
  LIMPID_REQUIRE(masks.size() <= std::numeric_limits<unsigned short>::max(),
    "There are " << masks.size()
                 << " masks (labels of masks have 16 bits). Choose an array with fewer components, "
                    "or one that has labels.");
  const double overlaps = ParallelBlockSum(count,
    [&](Index begin, Index end)
    {
      std::fill(values + begin, values + end, static_cast<unsigned short>(0));
      std::vector<bool> isDouble(static_cast<std::size_t>(end - begin));
      unsigned short label = 0;
      for (const FieldSource& mask : masks)
      {
        ++label;
        const bool isNumber = IsFloatingPoint(mask.array);
        for (Index i = begin; i < end; ++i)
        {
          const double value = mask.array->GetComponent(i, mask.component);
          if (isNumber ? value > 0.5 : value != 0)
          {
            isDouble[static_cast<std::size_t>(i - begin)] =
              isDouble[static_cast<std::size_t>(i - begin)] || values[i] != 0;
            values[i] = label;
          }
        }
      }
      return double(std::count(isDouble.begin(), isDouble.end(), true));
    });
  return { labels, static_cast<vtkIdType>(overlaps) };
}

vtkSmartPointer<vtkDataArray> ResampleLabels(const Grid& image, const Grid& labelled,
  vtkDataArray* labels, bool onCells, Resampling resampling)
{
  const SampleLattice lattice(image, labelled, onCells);
  const std::vector<Vec3> subSamples =
    resampling == Resampling::Majority ? lattice.SubSamples() : std::vector<Vec3>();
  vtkSmartPointer<vtkDataArray> result;
  switch (labels->GetDataType())
  {
    vtkTemplateMacro(result = NewLabels<VTK_TT>(labels->GetDataType(), image.NodeCount());
                     Resample(PointLabel<VTK_TT>{ lattice, subSamples,
                                static_cast<const VTK_TT*>(labels->GetVoidPointer(0)) },
                       image.nodes, static_cast<VTK_TT*>(result->GetVoidPointer(0))));
  }
  return result;
}

std::map<std::int64_t, vtkIdType> CountLabels(vtkDataArray* labels)
{
  std::map<std::int64_t, vtkIdType> counts;
  switch (labels->GetDataType())
  {
    vtkTemplateMacro(counts = CountIn(static_cast<const VTK_TT*>(labels->GetVoidPointer(0)),
                       labels->GetNumberOfTuples()));
  }
  return counts;
}
}
