// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SampledData.h"

#include "LatticeSamples.h"
#include "Memory.h"

#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkExtentTranslator.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"

#include "backend/PhysicalMemory.h"
#include "distributed/Communicator.h"
#include "math/Require.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

namespace limpid
{
namespace
{
// The box of an image is smaller than that of the data by this share of it on each side, since
// points on the border may be outside by rounding.
constexpr double Border = 1e-6;

// What all processes know of the data.
struct WholeData
{
  vtkBoundingBox box;
  std::int64_t cells = 0;           ///< on the finest level
  std::array<double, 3> cell{};     ///< median extents of cells
  std::array<double, 3> thinnest{}; ///< a twentieth of the cells of a rectilinear grid are thinner
};

// Returns the value that this share of all values is below.
double QuantileOf(std::vector<double>& values, double share)
{
  const auto at = values.begin() + std::ptrdiff_t(share * double(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// Whether all data of all ranks are rectilinear grids.
bool AreRectilinear(const Communicator& ranks, const std::vector<Leaf>& leaves)
{
  return !ranks.AnyOf(std::any_of(leaves.begin(), leaves.end(),
    [](const Leaf& leaf) { return leaf->GetDataObjectType() != VTK_RECTILINEAR_GRID; }));
}

WholeData Survey(
  const Communicator& ranks, const std::vector<Leaf>& leaves, const std::vector<Leaf>& finest)
{
  constexpr std::int64_t enough = 20000; // cells
  const auto size = std::size_t(ranks.Size());
  const auto own = std::size_t(ranks.Rank());
  WholeData whole;
  std::vector<double> bounds(6 * size, 0.0);
  const vtkBoundingBox box = BoxOf(leaves);
  if (box.IsValid())
  {
    box.GetBounds(&bounds[6 * own]);
  }
  ranks.Gather(bounds.data(), bounds.size());
  const std::vector<std::int64_t> filled = OfEachRank(ranks, box.IsValid() ? 1 : 0);
  for (std::size_t rank = 0; rank < size; ++rank)
  {
    if (filled[rank] != 0)
    {
      whole.box.AddBounds(&bounds[6 * rank]);
    }
  }
  whole.cells = CellsOf(finest);
  ranks.Sum(&whole.cells, 1);
  const bool isRectilinear = AreRectilinear(ranks, finest);
  const std::vector<std::array<double, 3>> extents =
    ExtentsOfCells(finest, vtkIdType(std::max<std::int64_t>(whole.cells / enough, 1)));
  const std::vector<std::int64_t> counts = OfEachRank(ranks, std::int64_t(extents.size()));
  std::size_t first = 0;
  std::size_t all = 0;
  for (std::size_t rank = 0; rank < size; ++rank)
  {
    first += rank < own ? std::size_t(counts[rank]) : 0;
    all += std::size_t(counts[rank]);
  }
  for (std::size_t axis = 0; axis < 3 && all > 0; ++axis)
  {
    std::vector<double> along(all, 0.0);
    std::transform(extents.begin(), extents.end(), along.begin() + std::ptrdiff_t(first),
      [axis](const std::array<double, 3>& extent) { return extent[axis]; });
    ranks.Gather(along.data(), along.size());
    whole.cell[axis] = QuantileOf(along, 0.5);
    constexpr double leastPart = 1e-3; // coordinates may be equal
    whole.thinnest[axis] = isRectilinear
      ? std::max(QuantileOf(along, 0.05), leastPart * whole.cell[axis])
      : whole.cell[axis];
  }
  return whole;
}

// The arrays of data, which all ranks know.
struct Catalog
{
  std::vector<SampledArray> ofPoints;
  std::vector<SampledArray> ofCells;

  double BytesOfPoint() const
  {
    double bytes = 0;
    for (const std::vector<SampledArray>* arrays : { &this->ofPoints, &this->ofCells })
    {
      for (const SampledArray& array : *arrays)
      {
        bytes += double(array.components) * vtkDataArray::GetDataTypeSize(array.type);
      }
    }
    return bytes;
  }
};

vtkIdType PointsInMemory(const Communicator& ranks, const Catalog& catalog, int copies)
{
  constexpr double made = 80; // bytes of a point in what a display makes of it
  constexpr double share = 0.7;
  constexpr double most = 1U << 29U;
  const double bytes = copies * (made + catalog.BytesOfPoint());
  auto points = static_cast<std::int32_t>(std::min(share * AvailableMemory() / bytes, most));
  ranks.TakeLeast(&points, 1);
  return points;
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

// Returns distances of points between the thinnest and the median cells: the smallest with which a
// stretched grid becomes an image of a size that is quickly optimised. Thin layers would be lost at
// the distance of the median.
std::array<double, 3> DistancesFor(const WholeData& whole)
{
  constexpr double quick = 4e6;
  constexpr double perCell = 4;
  constexpr int steps = 20;
  const double most = std::max(quick, perCell * double(whole.cells));
  std::array<double, 3> distances = whole.thinnest;
  for (int step = 1; step <= steps; ++step)
  {
    const std::array<int, 3> dimensions =
      DimensionsFor(whole.box, distances, std::numeric_limits<vtkIdType>::max());
    if (double(dimensions[0]) * dimensions[1] * dimensions[2] <= most)
    {
      break;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      distances[axis] = whole.thinnest[axis] *
        std::pow(whole.cell[axis] / whole.thinnest[axis], double(step) / steps);
    }
  }
  return distances;
}

std::string TextOf(const std::array<int, 3>& dimensions)
{
  std::ostringstream text;
  text << dimensions[0] << " x " << dimensions[1] << " x " << dimensions[2];
  return text.str();
}

// Returns the arrays of leaves. On ranks, those of the first that has any.
std::vector<SampledArray> CatalogOf(
  const Communicator& ranks, const std::vector<Leaf>& leaves, int association)
{
  std::vector<SampledArray> here;
  for (const std::string& name : ArraysOf(leaves, association))
  {
    for (const Leaf& leaf : leaves)
    {
      vtkDataSetAttributes* attributes = leaf->GetAttributes(association);
      vtkDataArray* array = attributes->GetArray(name.c_str());
      if (array && array->GetDataType() != VTK_BIT)
      {
        vtkDataArray* active = leaves.front()->GetAttributes(association)->GetScalars();
        const bool isActive = active && active->GetName() && active->GetName() == name;
        here.push_back({ name, array->GetDataType(), array->GetNumberOfComponents(), isActive });
        break;
      }
    }
  }
  return OfFirstThatHasAny(ranks, here);
}

std::set<std::string> NamesOf(const std::vector<SampledArray>& arrays)
{
  std::set<std::string> names;
  std::transform(arrays.begin(), arrays.end(), std::inserter(names, names.end()),
    [](const SampledArray& array) { return array.name; });
  return names;
}

// Leaves out arrays that are not wanted.
Catalog Wanted(const Catalog& all, const DataSampling& sampling)
{
  Catalog some;
  std::set<std::string> found;
  const auto take = [&](const std::vector<SampledArray>& from, std::vector<SampledArray>& to)
  {
    for (const SampledArray& array : from)
    {
      const bool isActive = array.isActive && sampling.wanted.count("") > 0;
      if (isActive || sampling.wanted.count(array.name) > 0 ||
        sampling.further.count(array.name) > 0 || sampling.labels.count(array.name) > 0)
      {
        to.push_back(array);
        found.insert(array.name);
        found.insert(isActive ? "" : array.name);
      }
    }
  };
  take(all.ofPoints, some.ofPoints);
  take(all.ofCells, some.ofCells);
  const bool hasAll =
    std::includes(found.begin(), found.end(), sampling.wanted.begin(), sampling.wanted.end());
  return hasAll && !sampling.wanted.empty() ? some : all;
}

// Blanks points without a valid sample.
void Blank(const LatticeSamples& samples, vtkImageData* image)
{
  const vtkIdType count = image->GetNumberOfPoints();
  const auto ghosts = NewArray<vtkUnsignedCharArray>(vtkDataSetAttributes::GhostArrayName(), count);
  bool any = false;
  for (vtkIdType point = 0; point < count; ++point)
  {
    const bool valid = samples.IsValid(point);
    any = any || !valid;
    ghosts->SetValue(point, valid ? 0 : vtkDataSetAttributes::HIDDENPOINT);
  }
  if (any)
  {
    image->GetPointData()->AddArray(ghosts);
  }
}

// Returns the lattice over the box, a little smaller, see Border. Origin and spacing have so few
// digits that coordinates are exact: points are the same in every part of the lattice.
Lattice LatticeOver(const vtkBoundingBox& box, const std::array<int, 3>& dimensions)
{
  constexpr int digits = 24;
  Lattice lattice;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = box.GetLength(int(axis));
    const double spacing = (1 - 2 * Border) * length / (dimensions[axis] - 1);
    const double unit = std::ldexp(1.0, std::ilogb(spacing) + 1 - digits);
    lattice.origin[axis] = std::ceil((box.GetMinPoint()[axis] + Border * length) / unit) * unit;
    lattice.spacing[axis] = std::floor(spacing / unit) * unit;
    lattice.extent[2 * axis] = 0;
    lattice.extent[2 * axis + 1] = dimensions[axis] - 1;
  }
  return lattice;
}

// Returns the part of a lattice that a rank shall have, with a layer around: averages of cells at
// points on its border need the cells on both sides.
Lattice PieceOf(const Lattice& whole, const Communicator& ranks)
{
  std::array<int, 6> all = whole.extent;
  Lattice piece = whole;
  vtkNew<vtkExtentTranslator> translator;
  const int has = translator->PieceToExtentThreadSafe(ranks.Rank(), ranks.Size(), 1, all.data(),
    piece.extent.data(), vtkExtentTranslator::BLOCK_MODE, 0);
  piece.extent = has ? piece.extent : std::array<int, 6>{ { 0, -1, 0, -1, 0, -1 } };
  return piece;
}

// Samples the data of this process, and exchanges what others want.
class Sampler
{
public:
  Sampler(const Communicator& ranks, const std::vector<Leaf>& leaves, const Catalog& catalog,
    const Lattice& whole, bool isWholeOnAll)
    : Ranks(ranks)
    , Leaves(leaves)
    , Arrays(catalog)
    , Here(ranks.IsAlone() ? whole : whole.Around(leaves))
    , Piece(ranks.IsAlone() || isWholeOnAll ? whole : PieceOf(whole, ranks))
  {
  }

  vtkSmartPointer<vtkImageData> Image(const std::set<std::string>& labels) const
  {
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetOrigin(this->Piece.origin.data());
    image->SetSpacing(this->Piece.spacing.data());
    image->SetExtent(const_cast<int*>(this->Piece.extent.data()));
    const LatticeSamples ofPoints = this->Wanted(this->SamplePoints(labels), this->Piece);
    Blank(ofPoints, image);
    Fill(ofPoints, this->Arrays.ofPoints, image->GetPointData());
    const LatticeSamples ofCells = this->Wanted(this->SampleCells(), this->Piece.OfCells());
    Fill(ofCells, this->Arrays.ofCells, image->GetCellData());
    return image;
  }

private:
  LatticeSamples SamplePoints(const std::set<std::string>& labels) const
  {
    const std::vector<SampledArray>& arrays = this->Arrays.ofPoints;
    LatticeSamples samples(this->Here, arrays);
    for (const Leaf& leaf : this->Leaves)
    {
      const std::vector<vtkIdType> points = samples.Add(WithArrays(leaf, NamesOf(arrays), {}));
      std::vector<vtkIdType> nearest;
      for (const std::string& label : labels)
      {
        if (vtkDataArray* array = leaf->GetPointData()->GetArray(label.c_str()))
        {
          nearest = nearest.empty() ? NearestOf(leaf, this->Here, points) : nearest;
          samples.Copy(array, nearest, points); // in place of what was interpolated
        }
      }
    }
    samples.TakeIntoRanges(this->Leaves, vtkDataObject::POINT);
    return samples;
  }

  LatticeSamples SampleCells() const
  {
    const std::vector<SampledArray>& arrays = this->Arrays.ofCells;
    LatticeSamples centres(this->Here.OfCells(), arrays);
    if (arrays.empty())
    {
      return centres;
    }
    LatticeSamples corners(this->Here, arrays);
    for (const Leaf& leaf : this->Leaves)
    {
      const Leaf cells = WithArrays(leaf, {}, NamesOf(arrays));
      centres.Add(cells);
      corners.Add(cells);
    }
    centres.Complete(corners);
    return centres;
  }

  LatticeSamples Wanted(LatticeSamples&& samples, const Lattice& lattice) const
  {
    return this->Ranks.IsAlone() ? std::move(samples) : samples.Shared(this->Ranks, lattice);
  }

  static void Fill(const LatticeSamples& samples, const std::vector<SampledArray>& arrays,
    vtkDataSetAttributes* attributes)
  {
    for (const vtkSmartPointer<vtkDataArray>& values : samples.Values())
    {
      attributes->AddArray(values);
    }
    for (const SampledArray& array : arrays)
    {
      if (array.isActive)
      {
        attributes->SetActiveScalars(array.name.c_str());
      }
    }
  }

  const Communicator& Ranks;
  const std::vector<Leaf>& Leaves;
  const Catalog& Arrays;
  Lattice Here;  ///< where this process has data
  Lattice Piece; ///< of the image, that this process gets
};
}

SampledData SampleData(vtkDataObject* data, const DataSampling& sampling, const Communicator& ranks)
{
  const std::vector<Leaf> leaves = LeavesOf(data);
  const WholeData whole = Survey(ranks, leaves, FinestOf(data));
  LIMPID_REQUIRE(whole.cell[0] > 0 && whole.cell[1] > 0 && whole.cell[2] > 0,
    "The input is a " << (data ? data->GetClassName() : "null pointer")
                      << " without cells that have a volume (there is nothing inside to be shown). "
                         "Give data with cells of three dimensions.");
  const std::array<int, 3> finest =
    DimensionsFor(whole.box, whole.thinnest, std::numeric_limits<vtkIdType>::max());
  const Catalog catalog = Wanted({ CatalogOf(ranks, leaves, vtkDataObject::POINT),
                                   CatalogOf(ranks, leaves, vtkDataObject::CELL) },
    sampling);
  const int copies = sampling.isWholeOnAll ? ranks.Size() : 1;
  const vtkIdType most =
    sampling.mostPoints > 0 ? sampling.mostPoints : PointsInMemory(ranks, catalog, copies);
  std::array<int, 3> dimensions = DimensionsFor(whole.box, DistancesFor(whole), most);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int given = sampling.dimensions[axis];
    dimensions[axis] = given > 0 ? std::max(given, 2) : dimensions[axis];
  }
  SampledData result;
  result.text = "sampled at " + TextOf(dimensions) + " points";
  if (dimensions != finest)
  {
    result.text += "; " + TextOf(finest) + " would be as fine as the data";
  }
  const Lattice lattice = LatticeOver(whole.box, dimensions);
  result.extent = lattice.extent;
  result.image =
    Sampler(ranks, leaves, catalog, lattice, sampling.isWholeOnAll).Image(sampling.labels);
  return result;
}

vtkSmartPointer<vtkInformationVector> WithImage(
  vtkInformationVector* input, const SampledData& sampled)
{
  vtkNew<vtkInformation> information;
  information->Copy(input->GetInformationObject(0));
  information->Set(vtkDataObject::DATA_OBJECT(), sampled.image);
  information->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), sampled.extent.data(), 6);
  auto with = vtkSmartPointer<vtkInformationVector>::New();
  with->Append(information);
  return with;
}
}
