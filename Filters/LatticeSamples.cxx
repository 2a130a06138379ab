// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "LatticeSamples.h"

#include "AllCores.h"
#include "ScalarMapping.h"

#include "vtkBoundingBox.h"
#include "vtkCharArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkGenericCell.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkProbeFilter.h"
#include "vtkSMPTools.h"
#include "vtkStaticPointLocator.h"

#include "backend/Backend.h"
#include "distributed/Communicator.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <sstream>

namespace limpid
{
namespace
{
const char* const Mask = "vtkValidPointMask"; // vtkProbeFilter's

std::size_t BytesOf(vtkDataArray* array)
{
  return std::size_t(array->GetNumberOfComponents()) * std::size_t(array->GetDataTypeSize());
}

// Returns how many probes shall work on a leaf at once. vtkProbeFilter uses the threads of
// vtkSMPTools, of which Debian's ParaView has one. Each probe looks at the bounds of all cells, so
// more would gain little.
int ProbesFor(vtkDataSet* leaf, const Lattice& lattice)
{
  constexpr int most = 8;
  constexpr vtkIdType least = 20000; // cells and points that are worth a probe
  const vtkIdType worthwhile = (leaf->GetNumberOfCells() + lattice.Count()) / least;
  const int threads = vtkSMPTools::GetEstimatedNumberOfThreads() > 1 ? 1 : ThreadCount();
  return static_cast<int>(
    std::max<vtkIdType>(std::min<vtkIdType>(worthwhile, std::min(threads, most)), 1));
}

// Returns a filter that samples a leaf. It has its own view of it, since data sets keep what they
// have computed.
vtkSmartPointer<vtkProbeFilter> ProbeOf(const Lattice& lattice, vtkDataSet* leaf)
{
  vtkNew<vtkImageData> image;
  image->SetOrigin(const_cast<double*>(lattice.origin.data()));
  image->SetSpacing(const_cast<double*>(lattice.spacing.data()));
  image->SetExtent(const_cast<int*>(lattice.extent.data()));
  vtkSmartPointer<vtkDataSet> view;
  view.TakeReference(leaf->NewInstance());
  view->ShallowCopy(leaf);
  // These are safe in several threads if one has called them before.
  vtkNew<vtkGenericCell> cell;
  double bounds[6];
  view->GetCell(0, cell);
  view->GetCellBounds(0, bounds);
  view->GetBounds(bounds);
  auto probe = vtkSmartPointer<vtkProbeFilter>::New();
  probe->SetInputData(image);
  probe->SetSourceData(view);
  return probe;
}

unsigned char* AddressIn(vtkDataArray* array, vtkIdType point)
{
  return static_cast<unsigned char*>(array->GetVoidPointer(0)) +
    std::size_t(point) * BytesOf(array);
}
}

vtkIdType Lattice::Count() const
{
  vtkIdType count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    count *= std::max(this->extent[2 * axis + 1] - this->extent[2 * axis] + 1, 0);
  }
  return count;
}

std::array<double, 3> Lattice::PointAt(vtkIdType number) const
{
  std::array<double, 3> point;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const vtkIdType along = this->extent[2 * axis + 1] - this->extent[2 * axis] + 1;
    const auto index = double(number % along + this->extent[2 * axis]);
    point[axis] = this->origin[axis] + index * this->spacing[axis];
    number /= along;
  }
  return point;
}

Lattice Lattice::Within(const std::array<int, 6>& other) const
{
  Lattice part = *this;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    part.extent[2 * axis] = std::max(this->extent[2 * axis], other[2 * axis]);
    part.extent[2 * axis + 1] = std::min(this->extent[2 * axis + 1], other[2 * axis + 1]);
  }
  return part;
}

Lattice Lattice::Around(const double bounds[6]) const
{
  std::array<int, 6> around;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto at = [&](double position, double furthest)
    {
      const double index = (position - this->origin[axis]) / this->spacing[axis] + furthest;
      return int(std::min(std::max(index, -2.0), 1e9));
    };
    around[2 * axis] = at(bounds[2 * axis], -1.0);
    around[2 * axis + 1] = at(bounds[2 * axis + 1], 1.0);
  }
  return this->Within(around);
}

Lattice Lattice::Around(const std::vector<Leaf>& leaves) const
{
  const vtkBoundingBox box = BoxOf(leaves);
  if (!box.IsValid())
  {
    return this->Within({ { 0, -1, 0, -1, 0, -1 } });
  }
  double bounds[6];
  box.GetBounds(bounds);
  return this->Around(bounds);
}

std::vector<Lattice> Lattice::Slabs(int most) const
{
  std::vector<Lattice> slabs;
  const int layers = this->Count() > 0 ? this->extent[5] - this->extent[4] + 1 : 0;
  const int count = std::min(most, layers);
  for (int slab = 0; slab < count; ++slab)
  {
    slabs.push_back(*this);
    slabs.back().extent[4] = this->extent[4] + layers * slab / count;
    slabs.back().extent[5] = this->extent[4] + layers * (slab + 1) / count - 1;
  }
  return slabs;
}

Lattice Lattice::OfCells() const
{
  Lattice centres = *this;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    centres.origin[axis] += 0.5 * this->spacing[axis];
    centres.extent[2 * axis + 1] -= 1;
  }
  return centres;
}

std::vector<std::int64_t> OfEachRank(const Communicator& ranks, std::int64_t here)
{
  std::vector<std::int64_t> numbers(std::size_t(ranks.Size()), 0);
  numbers[std::size_t(ranks.Rank())] = here;
  ranks.Sum(numbers.data(), numbers.size());
  return numbers;
}

std::vector<SampledArray> OfFirstThatHasAny(
  const Communicator& ranks, const std::vector<SampledArray>& here)
{
  std::ostringstream own;
  for (const SampledArray& array : here)
  {
    own << array.type << ' ' << array.components << ' ' << array.isActive << ' ' << array.name
        << '\n';
  }
  std::string text = own.str();
  const std::vector<std::int64_t> lengths = OfEachRank(ranks, std::int64_t(text.size()));
  const auto first =
    std::find_if(lengths.begin(), lengths.end(), [](std::int64_t length) { return length > 0; });
  if (first == lengths.end())
  {
    return {};
  }
  std::vector<std::int64_t> letters(std::size_t(*first), 0);
  if (first - lengths.begin() == ranks.Rank())
  {
    std::copy(text.begin(), text.end(), letters.begin());
  }
  ranks.Sum(letters.data(), letters.size());
  text.assign(letters.size(), ' ');
  std::transform(letters.begin(), letters.end(), text.begin(),
    [](std::int64_t letter) { return static_cast<char>(letter); });
  std::vector<SampledArray> arrays;
  std::istringstream lines(text);
  SampledArray array;
  while (lines >> array.type >> array.components >> array.isActive && lines.get() == ' ' &&
    std::getline(lines, array.name))
  {
    arrays.push_back(array);
  }
  return arrays;
}

LatticeSamples::LatticeSamples(const Lattice& lattice, const std::vector<SampledArray>& arrays)
  : Here(lattice)
  , Valid(std::size_t(lattice.Count()), 0)
{
  for (const SampledArray& array : arrays)
  {
    vtkSmartPointer<vtkDataArray> made;
    made.TakeReference(vtkDataArray::CreateDataArray(array.type));
    made->SetName(array.name.c_str());
    made->SetNumberOfComponents(array.components);
    made->SetNumberOfTuples(lattice.Count());
    made->Fill(0);
    this->Arrays.push_back(made);
  }
}

vtkIdType LatticeSamples::NumberOf(int i, int j, int k) const
{
  const std::array<int, 6>& e = this->Here.extent;
  const vtkIdType row = e[1] - e[0] + 1;
  return (i - e[0]) + row * ((j - e[2]) + vtkIdType(e[3] - e[2] + 1) * (k - e[4]));
}

// Returns the numbers of the points of a part.
std::vector<vtkIdType> LatticeSamples::NumbersIn(const Lattice& part) const
{
  std::vector<vtkIdType> numbers;
  numbers.reserve(std::size_t(part.Count()));
  for (int k = part.extent[4]; k <= part.extent[5]; ++k)
  {
    for (int j = part.extent[2]; j <= part.extent[3]; ++j)
    {
      for (int i = part.extent[0]; i <= part.extent[1]; ++i)
      {
        numbers.push_back(this->NumberOf(i, j, k));
      }
    }
  }
  return numbers;
}

void LatticeSamples::Use(vtkDataSetAttributes* values)
{
  for (vtkSmartPointer<vtkDataArray>& own : this->Arrays)
  {
    vtkDataArray* array = values->GetArray(own->GetName());
    own = array && array->GetNumberOfTuples() == own->GetNumberOfTuples() ? array : own.Get();
  }
  std::fill(this->Valid.begin(), this->Valid.end(), static_cast<unsigned char>(1));
}

std::vector<vtkIdType> LatticeSamples::Add(vtkDataSet* leaf)
{
  const Lattice part = this->Here.Around(leaf->GetBounds());
  const std::vector<Lattice> slabs = part.Slabs(ProbesFor(leaf, part));
  std::vector<vtkSmartPointer<vtkProbeFilter>> probes;
  std::transform(slabs.begin(), slabs.end(), std::back_inserter(probes),
    [leaf](const Lattice& slab) { return ProbeOf(slab, leaf); });
  ParallelFor(Index(probes.size()), [&](Index slab) { probes[std::size_t(slab)]->Update(); });
  std::vector<vtkIdType> sampled;
  for (std::size_t slab = 0; slab < slabs.size(); ++slab)
  {
    const std::vector<vtkIdType> points =
      this->Take(probes[slab]->GetOutput()->GetPointData(), slabs[slab]);
    sampled.insert(sampled.end(), points.begin(), points.end());
    probes[slab] = nullptr;
  }
  return sampled;
}

std::vector<vtkIdType> LatticeSamples::Take(vtkPointData* sampled, const Lattice& part)
{
  auto* mask = vtkCharArray::SafeDownCast(sampled->GetArray(Mask));
  vtkDataArray* hidden = sampled->GetArray(hiddenCells);
  if (!mask)
  {
    return {};
  }
  std::vector<vtkIdType> from;
  std::vector<vtkIdType> to;
  vtkIdType here = 0;
  for (const vtkIdType there : this->NumbersIn(part))
  {
    const bool isBlanked = hidden && hidden->GetComponent(here, 0) != 0;
    if (mask->GetValue(here) != 0 && !isBlanked && !this->IsValid(there))
    {
      from.push_back(here);
      to.push_back(there);
      this->Valid[std::size_t(there)] = 1;
    }
    ++here;
  }
  for (int number = 0; number < sampled->GetNumberOfArrays(); ++number)
  {
    vtkDataArray* array = sampled->GetArray(number);
    if (array && array->GetName())
    {
      this->Copy(array, from, to);
    }
  }
  return to;
}

void LatticeSamples::Copy(
  vtkDataArray* array, const std::vector<vtkIdType>& from, const std::vector<vtkIdType>& to)
{
  for (const vtkSmartPointer<vtkDataArray>& own : this->Arrays)
  {
    if (own->GetName() == std::string(array->GetName()) &&
      own->GetNumberOfComponents() == array->GetNumberOfComponents())
    {
      ForOnAllCores(vtkIdType(from.size()),
        [&](vtkIdType begin, vtkIdType end)
        {
          for (vtkIdType i = begin; i < end; ++i)
          {
            own->SetTuple(to[std::size_t(i)], from[std::size_t(i)], array);
          }
        });
    }
  }
}

void LatticeSamples::Complete(const LatticeSamples& corners)
{
  const std::array<int, 6>& e = this->Here.extent;
  std::vector<vtkIdType> from;
  std::vector<vtkIdType> to;
  vtkIdType cell = 0;
  for (int k = e[4]; k <= e[5]; ++k)
  {
    for (int j = e[2]; j <= e[3]; ++j)
    {
      for (int i = e[0]; i <= e[1]; ++i, ++cell)
      {
        for (int corner = 0; corner < 8 && !this->IsValid(cell); ++corner)
        {
          const vtkIdType point =
            corners.NumberOf(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
          if (corners.IsValid(point))
          {
            from.push_back(point);
            to.push_back(cell);
            this->Valid[std::size_t(cell)] = 2;
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

void LatticeSamples::TakeIntoRanges(const std::vector<Leaf>& leaves, int association)
{
  for (const vtkSmartPointer<vtkDataArray>& array : this->Arrays)
  {
    if (array->GetNumberOfComponents() != 1)
    {
      continue;
    }
    double least = 0; // outside of all cells
    double most = 0;
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
    ForOnAllCores(array->GetNumberOfTuples(),
      [&](vtkIdType begin, vtkIdType end)
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
}

std::size_t LatticeSamples::BytesOfPoint() const
{
  std::size_t bytes = 1;
  for (const vtkSmartPointer<vtkDataArray>& array : this->Arrays)
  {
    bytes += BytesOf(array);
  }
  return bytes;
}

// Returns whether each point of a part is valid, and its values.
std::vector<unsigned char> LatticeSamples::Packed(const Lattice& part) const
{
  std::vector<unsigned char> packed(std::size_t(part.Count()) * this->BytesOfPoint());
  unsigned char* to = packed.data();
  for (const vtkIdType point : this->NumbersIn(part))
  {
    *to = this->Valid[std::size_t(point)];
    ++to;
    for (const vtkSmartPointer<vtkDataArray>& array : this->Arrays)
    {
      std::memcpy(to, AddressIn(array, point), BytesOf(array));
      to += BytesOf(array);
    }
  }
  return packed;
}

// Takes values of points that have none, or have been completed only.
void LatticeSamples::Unpack(const Lattice& part, const std::vector<unsigned char>& packed)
{
  const unsigned char* from = packed.data();
  for (const vtkIdType point : this->NumbersIn(part))
  {
    unsigned char& valid = this->Valid[std::size_t(point)];
    const unsigned char there = *from;
    ++from;
    const bool takes = there != 0 && (valid == 0 || there < valid);
    valid = takes ? there : valid;
    for (const vtkSmartPointer<vtkDataArray>& array : this->Arrays)
    {
      if (takes)
      {
        std::memcpy(AddressIn(array, point), from, BytesOf(array));
      }
      from += BytesOf(array);
    }
  }
}

LatticeSamples LatticeSamples::Shared(const Communicator& ranks, const Lattice& lattice) const
{
  const auto size = std::size_t(ranks.Size());
  const auto own = std::size_t(ranks.Rank());
  std::vector<std::int64_t> extents(12 * size, 0); // of what each has, and of what each wants
  std::copy(this->Here.extent.begin(), this->Here.extent.end(), &extents[12 * own]);
  std::copy(lattice.extent.begin(), lattice.extent.end(), &extents[12 * own + 6]);
  ranks.Sum(extents.data(), extents.size());
  const auto extentAt = [&](std::size_t first)
  {
    std::array<int, 6> extent;
    std::transform(&extents[first], &extents[first] + 6, extent.begin(),
      [](std::int64_t bound) { return int(bound); });
    return extent;
  };
  LatticeSamples shared(lattice, {});
  for (const vtkSmartPointer<vtkDataArray>& array : this->Arrays)
  {
    const LatticeSamples one(
      lattice, { { array->GetName(), array->GetDataType(), array->GetNumberOfComponents() } });
    shared.Arrays.push_back(one.Arrays.front());
  }
  std::vector<std::vector<unsigned char>> sent(size);
  std::vector<std::vector<unsigned char>> received(size);
  std::vector<Lattice> parts(size);
  std::vector<Communicator::Message> sends;
  std::vector<Communicator::Message> receives;
  for (std::size_t rank = 0; rank < size; ++rank)
  {
    const int number = static_cast<int>(rank);
    sent[rank] = this->Packed(this->Here.Within(extentAt(12 * rank + 6)));
    parts[rank] = lattice.Within(extentAt(12 * rank));
    if (rank == own)
    {
      received[rank] = sent[rank];
      continue;
    }
    received[rank].resize(std::size_t(parts[rank].Count()) * this->BytesOfPoint());
    if (!sent[rank].empty())
    {
      sends.push_back({ number, sent[rank].data(), sent[rank].size() });
    }
    if (!received[rank].empty())
    {
      receives.push_back({ number, received[rank].data(), received[rank].size() });
    }
  }
  ranks.Exchange(sends, receives);
  for (std::size_t rank = 0; rank < size; ++rank)
  {
    shared.Unpack(parts[rank], received[rank]);
  }
  return shared;
}

std::vector<vtkIdType> NearestOf(
  vtkDataSet* leaf, const Lattice& lattice, const std::vector<vtkIdType>& points)
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
        const std::array<double, 3> at = lattice.PointAt(points[std::size_t(i)]);
        nearest[std::size_t(i)] = locator->FindClosestPoint(at.data());
      }
    });
  return nearest;
}
}
