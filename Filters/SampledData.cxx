// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SampledData.h"

#include "AllCores.h"
#include "Memory.h"
#include "ScalarMapping.h"

#include "vtkBoundingBox.h"
#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkCharArray.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkHyperTreeGrid.h"
#include "vtkHyperTreeGridToUnstructuredGrid.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkProbeFilter.h"
#include "vtkStaticPointLocator.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUniformGrid.h"
#include "vtkUniformGridAMR.h"
#include "vtkUnsignedCharArray.h"

#include "backend/PhysicalMemory.h"
#include "math/Require.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace limpid
{
namespace
{
using Leaf = vtkSmartPointer<vtkDataSet>;

const char* const Mask = "vtkValidPointMask"; // vtkProbeFilter's
const char* const Hidden = "LimpidHidden";    // cells that are blanked

// The box of an image is smaller than that of the data by this share of it on each side, since
// points on the border may be outside by rounding.
constexpr double Border = 1e-6;

vtkSmartPointer<vtkDataSet> AsDataSet(vtkDataObject* object)
{
  if (auto* trees = vtkHyperTreeGrid::SafeDownCast(object))
  {
    vtkNew<vtkHyperTreeGridToUnstructuredGrid> cells;
    cells->SetInputData(trees);
    cells->Update();
    return vtkDataSet::SafeDownCast(cells->GetOutput());
  }
  return vtkDataSet::SafeDownCast(object);
}

bool IsFilled(vtkDataSet* leaf)
{
  return leaf && leaf->GetNumberOfPoints() > 0 && leaf->GetNumberOfCells() > 0;
}

// Returns the data sets, in the order in which they count: those of the finest level first.
std::vector<Leaf> LeavesOf(vtkDataObject* data)
{
  std::vector<Leaf> leaves;
  const auto add = [&leaves](vtkDataObject* object)
  {
    const Leaf leaf = AsDataSet(object);
    if (IsFilled(leaf))
    {
      leaves.push_back(leaf);
    }
  };
  if (auto* levels = vtkUniformGridAMR::SafeDownCast(data))
  {
    for (unsigned level = levels->GetNumberOfLevels(); level-- > 0;)
    {
      for (unsigned block = 0; block < levels->GetNumberOfDataSets(level); ++block)
      {
        add(levels->GetDataSet(level, block));
      }
    }
    return leaves;
  }
  auto* blocks = vtkCompositeDataSet::SafeDownCast(data);
  if (!blocks)
  {
    add(data);
    return leaves;
  }
  vtkSmartPointer<vtkCompositeDataIterator> block;
  block.TakeReference(blocks->NewIterator());
  block->SkipEmptyNodesOn();
  for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
  {
    add(block->GetCurrentDataObject());
  }
  return leaves;
}

// Returns the leaves whose cells are as fine as the image shall be.
std::vector<Leaf> FinestOf(vtkDataObject* data, const std::vector<Leaf>& leaves)
{
  auto* levels = vtkUniformGridAMR::SafeDownCast(data);
  if (!levels)
  {
    return leaves;
  }
  for (unsigned level = levels->GetNumberOfLevels(); level-- > 0;)
  {
    std::vector<Leaf> finest;
    for (unsigned block = 0; block < levels->GetNumberOfDataSets(level); ++block)
    {
      if (IsFilled(levels->GetDataSet(level, block)))
      {
        finest.emplace_back(levels->GetDataSet(level, block));
      }
    }
    if (!finest.empty())
    {
      return finest;
    }
  }
  return leaves;
}

double MedianOf(std::vector<double>& values)
{
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Returns the median extents of cells with a volume; zero if there are none.
std::array<double, 3> ExtentsOfCells(const std::vector<Leaf>& leaves)
{
  constexpr vtkIdType enough = 20000;
  vtkIdType all = 0;
  for (const Leaf& leaf : leaves)
  {
    all += leaf->GetNumberOfCells();
  }
  const vtkIdType step = std::max<vtkIdType>(all / enough, 1);
  std::array<std::vector<double>, 3> extents;
  vtkIdType number = 0;
  for (const Leaf& leaf : leaves)
  {
    for (vtkIdType cell = 0; cell < leaf->GetNumberOfCells(); ++cell, ++number)
    {
      if (number % step == 0 && leaf->GetCell(cell)->GetCellDimension() == 3)
      {
        double bounds[6];
        leaf->GetCellBounds(cell, bounds);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          extents[axis].push_back(bounds[2 * axis + 1] - bounds[2 * axis]);
        }
      }
    }
  }
  std::array<double, 3> medians{ { 0, 0, 0 } };
  for (std::size_t axis = 0; axis < 3 && !extents[axis].empty(); ++axis)
  {
    medians[axis] = MedianOf(extents[axis]);
  }
  return medians;
}

vtkIdType PointsInMemory()
{
  constexpr double bytes = 100; // of a point, with everything that is made of it
  constexpr double share = 0.7;
  constexpr double most = 1U << 29U;
  return static_cast<vtkIdType>(std::min(share * AvailableMemory() / bytes, most));
}

// Returns the dimensions of an image with these distances of points, or larger ones.
std::array<int, 3> DimensionsFor(
  const vtkBoundingBox& box, const std::array<double, 3>& distances, vtkIdType mostPoints)
{
  constexpr double mostAlong = 4096;
  const auto along = [&](int axis, double times)
  {
    const double cells = box.GetLength(axis) / (times * distances[std::size_t(axis)]);
    return int(std::min(std::max(std::round(cells), 1.0), mostAlong)) + 1;
  };
  const auto with = [&](double times) -> std::array<int, 3> {
    return { { along(0, times), along(1, times), along(2, times) } };
  };
  double times = 1;
  const auto tooMany = [&](const std::array<int, 3>& dimensions)
  { return double(dimensions[0]) * dimensions[1] * dimensions[2] > double(mostPoints); };
  while (tooMany(with(times)) && times < mostAlong)
  {
    times *= 1.02;
  }
  return with(times);
}

std::string TextOf(const std::array<int, 3>& dimensions)
{
  std::ostringstream text;
  text << dimensions[0] << " x " << dimensions[1] << " x " << dimensions[2];
  return text.str();
}

// Returns the points of a leaf that are nearest to points of an image.
std::vector<vtkIdType> NearestOf(
  vtkDataSet* leaf, vtkImageData* image, const std::vector<vtkIdType>& points)
{
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(leaf);
  locator->BuildLocator();
  std::vector<vtkIdType> nearest(points.size());
  ForOnAllCores(vtkIdType(points.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        double at[3];
        image->GetPoint(points[std::size_t(i)], at);
        nearest[std::size_t(i)] = locator->FindClosestPoint(at);
      }
    });
  return nearest;
}

// Returns a leaf with some of its arrays, and one that marks what is blanked; null if none of the
// cells may be seen.
Leaf WithArrays(vtkDataSet* leaf, const std::set<std::string>& points, bool cells)
{
  Leaf with;
  with.TakeReference(leaf->NewInstance());
  with->CopyStructure(leaf);
  const auto pass = [](vtkDataSetAttributes* from, vtkDataSetAttributes* to, const auto& wanted)
  {
    for (int i = 0; i < from->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = from->GetArray(i);
      if (array && array->GetName() && wanted(std::string(array->GetName())))
      {
        to->AddArray(array);
      }
    }
  };
  const auto isGhosts = [](const std::string& name)
  { return name == vtkDataSetAttributes::GhostArrayName(); };
  pass(leaf->GetPointData(), with->GetPointData(),
    [&](const std::string& name) { return points.count(name) > 0; });
  pass(leaf->GetCellData(), with->GetCellData(),
    [&](const std::string& name) { return cells && !isGhosts(name); });

  vtkUnsignedCharArray* ofCells = leaf->GetCellGhostArray();
  vtkUnsignedCharArray* ofPoints = leaf->GetPointGhostArray();
  if (!ofCells && !ofPoints)
  {
    return with;
  }
  constexpr int blanked = vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL;
  const vtkIdType count = leaf->GetNumberOfCells();
  const auto hidden = NewArray<vtkUnsignedCharArray>(Hidden, count);
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    bool isHidden = ofCells && (ofCells->GetValue(cell) & blanked) != 0;
    if (ofPoints && !isHidden)
    {
      leaf->GetCellPoints(cell, ids);
      for (vtkIdType i = 0; i < ids->GetNumberOfIds() && !isHidden; ++i)
      {
        isHidden = (ofPoints->GetValue(ids->GetId(i)) & vtkDataSetAttributes::HIDDENPOINT) != 0;
      }
    }
    hidden->SetValue(cell, isHidden ? 1 : 0);
  }
  with->GetCellData()->AddArray(hidden);
  return with;
}

// Weights of interpolation add up to one but for rounding. Takes values into the range of the array
// that they are interpolated from.
void TakeIntoRange(const std::vector<Leaf>& leaves, int association, vtkDataArray* array)
{
  if (array->GetNumberOfComponents() != 1 || array->GetDataType() == VTK_BIT)
  {
    return;
  }
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (const Leaf& leaf : leaves)
  {
    vtkDataArray* source = leaf->GetAttributes(association)->GetArray(array->GetName());
    if (source && source->GetNumberOfComponents() == 1)
    {
      double low = 0;
      double high = 0;
      FiniteRange(source, 0, low, high);
      least = std::min(least, low);
      most = std::max(most, high);
    }
  }
  least = std::min(least, 0.0); // outside of all cells
  most = std::max(most, 0.0);
  ForOnAllCores(array->GetNumberOfTuples(),
    [=](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const double value = array->GetComponent(i, 0);
        if (value < least || value > most)
        {
          array->SetComponent(i, 0, value < least ? least : most);
        }
      }
    });
}

// The samples of all leaves at the points of an image, or at the centres of its cells.
class Samples
{
public:
  enum class At
  {
    Points,
    Centres // of cells
  };

  Samples(vtkImageData* image, At at)
  {
    image->GetDimensions(this->Points.data());
    image->GetOrigin(this->Origin);
    image->GetSpacing(this->Spacing);
    for (std::size_t axis = 0; axis < 3 && at == At::Centres; ++axis)
    {
      this->Points[axis] -= 1;
      this->Origin[axis] += 0.5 * this->Spacing[axis];
    }
    this->Valid = NewArray<vtkCharArray>(Mask, this->Count());
    this->Valid->FillValue(0);
  }

  // Samples a leaf where no other one was. Returns these points.
  std::vector<vtkIdType> Add(vtkDataSet* leaf)
  {
    int extent[6];
    if (!this->ExtentOf(leaf, extent))
    {
      return {};
    }
    vtkNew<vtkImageData> lattice;
    lattice->SetOrigin(this->Origin);
    lattice->SetSpacing(this->Spacing);
    lattice->SetExtent(extent);
    vtkNew<vtkProbeFilter> probe;
    probe->SetInputData(lattice);
    probe->SetSourceData(leaf);
    probe->Update();
    return this->Take(probe->GetOutput()->GetPointData(), extent);
  }

  // Copies values of an array, at points `from`, to points `to`.
  void Copy(
    vtkDataArray* array, const std::vector<vtkIdType>& from, const std::vector<vtkIdType>& to)
  {
    if (vtkDataArray* all = this->ArrayLike(array))
    {
      ForOnAllCores(vtkIdType(from.size()),
        [&](vtkIdType begin, vtkIdType end)
        {
          for (vtkIdType i = begin; i < end; ++i)
          {
            all->SetTuple(to[std::size_t(i)], from[std::size_t(i)], array);
          }
        });
    }
  }

  bool IsValid(vtkIdType point) const { return this->Valid->GetValue(point) != 0; }
  vtkIdType NumberOf(int i, int j, int k) const
  {
    return i + this->Points[0] * (j + vtkIdType(this->Points[1]) * k);
  }
  vtkIdType Count() const { return vtkIdType(this->Points[0]) * this->Points[1] * this->Points[2]; }

  // Gives cells without a valid sample the values at one of their corners that has one. `corners`:
  // the samples at the corners of these cells, of the same arrays.
  void Complete(const Samples& corners)
  {
    std::vector<vtkIdType> from;
    std::vector<vtkIdType> to;
    vtkIdType cell = 0;
    for (int k = 0; k < this->Points[2]; ++k)
    {
      for (int j = 0; j < this->Points[1]; ++j)
      {
        for (int i = 0; i < this->Points[0]; ++i, ++cell)
        {
          for (int corner = 0; corner < 8 && !this->IsValid(cell); ++corner)
          {
            const vtkIdType point =
              corners.NumberOf(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
            if (corners.IsValid(point))
            {
              from.push_back(point);
              to.push_back(cell);
              this->Valid->SetValue(cell, 1);
            }
          }
        }
      }
    }
    for (const vtkSmartPointer<vtkDataArray>& array : corners.Arrays)
    {
      this->Copy(array, from, to);
    }
  }

  // Moves the values to attributes of an image. `association`: of the arrays of the leaves.
  void MoveTo(vtkDataSetAttributes* attributes, const std::vector<Leaf>& leaves, int association)
  {
    for (const vtkSmartPointer<vtkDataArray>& array : this->Arrays)
    {
      TakeIntoRange(leaves, association, array);
      attributes->AddArray(array);
    }
    vtkDataArray* scalars = leaves.front()->GetAttributes(association)->GetScalars();
    attributes->SetActiveScalars(scalars ? scalars->GetName() : nullptr);
    this->Arrays.clear();
  }

private:
  // Finds the points that may be in a leaf; false: none.
  bool ExtentOf(vtkDataSet* leaf, int* extent) const
  {
    const double* bounds = leaf->GetBounds();
    for (int axis = 0; axis < 3; ++axis)
    {
      const double low = (bounds[2 * axis] - this->Origin[axis]) / this->Spacing[axis];
      const double high = (bounds[2 * axis + 1] - this->Origin[axis]) / this->Spacing[axis];
      extent[2 * axis] = int(std::max(std::floor(low), 0.0));
      extent[2 * axis + 1] =
        int(std::min(std::ceil(high), double(this->Points[std::size_t(axis)] - 1)));
      if (extent[2 * axis] > extent[2 * axis + 1])
      {
        return false;
      }
    }
    return true;
  }

  vtkDataArray* ArrayLike(vtkDataArray* other)
  {
    for (const vtkSmartPointer<vtkDataArray>& array : this->Arrays)
    {
      if (array->GetName() == std::string(other->GetName()))
      {
        const bool fits = array->GetNumberOfComponents() == other->GetNumberOfComponents();
        return fits ? array : nullptr;
      }
    }
    vtkSmartPointer<vtkDataArray> made;
    made.TakeReference(other->NewInstance());
    made->SetName(other->GetName());
    made->SetNumberOfComponents(other->GetNumberOfComponents());
    made->SetNumberOfTuples(this->Count());
    made->Fill(0);
    this->Arrays.push_back(made);
    return made;
  }

  std::vector<vtkIdType> Take(vtkPointData* sampled, const int* extent)
  {
    auto* mask = vtkCharArray::SafeDownCast(sampled->GetArray(Mask));
    vtkDataArray* hidden = sampled->GetArray(Hidden);
    if (!mask)
    {
      return {};
    }
    std::vector<vtkIdType> from;
    std::vector<vtkIdType> to;
    vtkIdType here = 0;
    for (int k = extent[4]; k <= extent[5]; ++k)
    {
      for (int j = extent[2]; j <= extent[3]; ++j)
      {
        for (int i = extent[0]; i <= extent[1]; ++i, ++here)
        {
          const vtkIdType there = this->NumberOf(i, j, k);
          const bool isBlanked = hidden && hidden->GetTuple1(here) != 0;
          if (mask->GetValue(here) != 0 && !isBlanked && !this->IsValid(there))
          {
            from.push_back(here);
            to.push_back(there);
            this->Valid->SetValue(there, 1);
          }
        }
      }
    }
    for (int number = 0; number < sampled->GetNumberOfArrays(); ++number)
    {
      vtkDataArray* array = sampled->GetArray(number);
      const std::string name = array && array->GetName() ? array->GetName() : "";
      if (!name.empty() && name != Mask && name != Hidden)
      {
        this->Copy(array, from, to);
      }
    }
    return to;
  }

  std::array<int, 3> Points;
  double Origin[3];
  double Spacing[3];
  vtkSmartPointer<vtkCharArray> Valid;
  std::vector<vtkSmartPointer<vtkDataArray>> Arrays;
};

std::set<std::string> ArraysOf(const std::vector<Leaf>& leaves, int association)
{
  std::set<std::string> names;
  for (const Leaf& leaf : leaves)
  {
    vtkDataSetAttributes* attributes = leaf->GetAttributes(association);
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = attributes->GetArray(i);
      const std::string name = array && array->GetName() ? array->GetName() : "";
      if (!name.empty() && name != vtkDataSetAttributes::GhostArrayName())
      {
        names.insert(name);
      }
    }
  }
  return names;
}

// Blanks points without a valid sample.
void Blank(const Samples& samples, vtkPointData* points)
{
  const auto ghosts =
    NewArray<vtkUnsignedCharArray>(vtkDataSetAttributes::GhostArrayName(), samples.Count());
  bool any = false;
  for (vtkIdType point = 0; point < samples.Count(); ++point)
  {
    const bool valid = samples.IsValid(point);
    any = any || !valid;
    ghosts->SetValue(point, valid ? 0 : vtkDataSetAttributes::HIDDENPOINT);
  }
  if (any)
  {
    points->AddArray(ghosts);
  }
}

// Returns an image over the box, a little smaller, see Border.
vtkSmartPointer<vtkImageData> ImageOver(
  const vtkBoundingBox& box, const std::array<int, 3>& dimensions)
{
  double origin[3];
  double spacing[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const double border = Border * box.GetLength(axis);
    origin[axis] = box.GetMinPoint()[axis] + border;
    spacing[axis] = (box.GetLength(axis) - 2 * border) / (dimensions[std::size_t(axis)] - 1);
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(dimensions.data());
  image->SetOrigin(origin);
  image->SetSpacing(spacing);
  return image;
}

void SamplePoints(
  const std::vector<Leaf>& leaves, const std::set<std::string>& labels, vtkImageData* image)
{
  const std::set<std::string> names = ArraysOf(leaves, vtkDataObject::POINT);
  Samples samples(image, Samples::At::Points);
  for (const Leaf& leaf : leaves)
  {
    const std::vector<vtkIdType> points = samples.Add(WithArrays(leaf, names, false));
    std::vector<vtkIdType> nearest;
    for (const std::string& label : labels)
    {
      if (vtkDataArray* array = leaf->GetPointData()->GetArray(label.c_str()))
      {
        nearest = nearest.empty() ? NearestOf(leaf, image, points) : nearest;
        samples.Copy(array, nearest, points); // in place of what was interpolated
      }
    }
  }
  samples.MoveTo(image->GetPointData(), leaves, vtkDataObject::POINT);
  Blank(samples, image->GetPointData());
}

void SampleCells(const std::vector<Leaf>& leaves, vtkImageData* image)
{
  if (ArraysOf(leaves, vtkDataObject::CELL).empty())
  {
    return;
  }
  Samples centres(image, Samples::At::Centres);
  Samples corners(image, Samples::At::Points);
  for (const Leaf& leaf : leaves)
  {
    const Leaf cells = WithArrays(leaf, {}, true);
    centres.Add(cells);
    corners.Add(cells);
  }
  centres.Complete(corners);
  centres.MoveTo(image->GetCellData(), leaves, vtkDataObject::CELL);
}
}

SampledData SampleData(vtkDataObject* data, const DataSampling& sampling)
{
  const std::vector<Leaf> leaves = LeavesOf(data);
  const std::array<double, 3> extents = ExtentsOfCells(FinestOf(data, leaves));
  LIMPID_REQUIRE(extents[0] > 0 && extents[1] > 0 && extents[2] > 0,
    "The input is a " << (data ? data->GetClassName() : "null pointer")
                      << " whose cells have no volume (there is nothing inside to be shown). Give "
                         "data with cells of three dimensions.");
  vtkBoundingBox box;
  for (const Leaf& leaf : leaves)
  {
    box.AddBounds(leaf->GetBounds());
  }
  const std::array<int, 3> finest =
    DimensionsFor(box, extents, std::numeric_limits<vtkIdType>::max());
  std::array<int, 3> dimensions =
    DimensionsFor(box, extents, sampling.mostPoints > 0 ? sampling.mostPoints : PointsInMemory());
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int given = sampling.dimensions[axis];
    dimensions[axis] = given > 0 ? std::max(given, 2) : dimensions[axis];
  }
  SampledData result{ ImageOver(box, dimensions), "sampled at " + TextOf(dimensions) + " points" };
  if (dimensions != finest)
  {
    result.text += "; " + TextOf(finest) + " would be as fine as the data";
  }
  SamplePoints(leaves, sampling.labels, result.image);
  SampleCells(leaves, result.image);
  return result;
}

vtkSmartPointer<vtkInformationVector> WithImage(vtkInformationVector* input, vtkImageData* image)
{
  vtkNew<vtkInformation> information;
  information->Copy(input->GetInformationObject(0));
  information->Set(vtkDataObject::DATA_OBJECT(), image);
  information->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), image->GetExtent(), 6);
  auto with = vtkSmartPointer<vtkInformationVector>::New();
  with->Append(information);
  return with;
}
}
