// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SharedArray.h"

#include "vtkCommunicator.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMultiProcessController.h"

#include "scene/NodeBox.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace limpid
{
SharedArray::SharedArray(const FieldSource& source, vtkImageData* image, const int wholeExtent[6],
  vtkMultiProcessController* processes, const NodeBox* owned)
  : Array(source.array)
  , Component(source.component)
  , Processes(processes)
{
  const int* here = image->GetExtent();
  const int* whole = processes ? wholeExtent : here;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto at = static_cast<std::size_t>(axis);
    const int cells = source.onCells ? 1 : 0;
    const int begin = here[2 * axis];
    const int end = here[2 * axis + 1];
    const auto sizeOf = [cells](int first, int last)
    { return std::max(last - first + 1 - cells, last >= first ? 1 : 0); };
    this->First[at] = begin - whole[2 * axis];
    this->Size[at] = sizeOf(begin, end);
    this->Whole[at] = sizeOf(whole[2 * axis], whole[2 * axis + 1]);
    // Both neighbours have the points on their common border; the next one owns them.
    const bool isLast = end == whole[2 * axis + 1];
    const Range<int> own = owned
      ? owned->along[at]
      : Range<int>{ this->First[at], this->First[at] + end - begin + isLast };
    this->Skipped[at] = own.begin - this->First[at];
    this->Own[at] = std::min(own.end - this->First[at], this->Size[at]);
  }
}

std::array<double, 2> SharedArray::FiniteRange() const
{
  constexpr double most = std::numeric_limits<double>::max();
  std::array<double, 2> range{ { most, -most } };
  if (this->Array)
  {
    this->Array->GetFiniteRange(
      range.data(), this->Array->GetNumberOfComponents() > 1 ? this->Component : 0);
  }
  if (this->Processes)
  {
    std::array<double, 2> ends{ { range[0], -range[1] } };
    std::array<double, 2> least{};
    this->Processes->AllReduce(ends.data(), least.data(), 2, vtkCommunicator::MIN_OP);
    range = { { least[0], -least[1] } };
  }
  return range[0] <= range[1] ? range : std::array<double, 2>{};
}

double SharedArray::ValueAt(int i, int j, int k) const
{
  using Number = long long;
  const Number tuple = (Number(k) * this->Size[1] + j) * this->Size[0] + i;
  const int components = this->Array->GetNumberOfComponents();
  if (components == 1 || this->Component != MagnitudeComponent)
  {
    return this->Array->GetComponent(tuple, std::max(this->Component, 0));
  }
  double value = 0;
  for (int component = 0; component < components; ++component)
  {
    value = std::hypot(value, this->Array->GetComponent(tuple, component));
  }
  return value;
}

// Calls visit(i, j, k, value) for the finite values of this process among the samples at equal
// distances in the whole array.
template <class Visit>
void SharedArray::VisitSamples(long long most, const Visit& visit) const
{
  using Number = long long;
  const std::array<int, 3>& whole = this->Whole;
  const Number tuples = Number(whole[0]) * whole[1] * whole[2];
  const Number step = std::max<Number>(1, tuples / most) | 1; // odd, to sample all columns
  for (int k = this->Skipped[2]; this->Array && k < this->Own[2]; ++k)
  {
    for (int j = this->Skipped[1]; j < this->Own[1]; ++j)
    {
      const Number row =
        (Number(k + this->First[2]) * whole[1] + j + this->First[1]) * whole[0] + this->First[0];
      const Number first = this->Skipped[0];
      const Number before = (row + first) % step;
      for (Number i = first + (before == 0 ? 0 : step - before); i < this->Own[0]; i += step)
      {
        const double value = this->ValueAt(static_cast<int>(i), j, k);
        if (std::isfinite(value))
        {
          visit(static_cast<int>(i), j, k, value);
        }
      }
    }
  }
}

// Returns the numbers of all processes.
std::vector<double> SharedArray::Gathered(std::vector<double> here) const
{
  if (!this->Processes)
  {
    return here;
  }
  const auto count = static_cast<vtkIdType>(here.size());
  std::vector<vtkIdType> counts(static_cast<std::size_t>(this->Processes->GetNumberOfProcesses()));
  this->Processes->AllGather(&count, counts.data(), 1);
  std::vector<vtkIdType> begins(counts.size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), begins.begin() + 1);
  std::vector<double> all(static_cast<std::size_t>(begins.back()));
  this->Processes->AllGatherV(here.data(), all.data(), count, counts.data(), begins.data());
  return all;
}

std::vector<double> SharedArray::Samples(long long most) const
{
  std::vector<double> here;
  this->VisitSamples(most, [&here](int, int, int, double value) { here.push_back(value); });
  std::vector<double> samples = this->Gathered(std::move(here));
  std::sort(samples.begin(), samples.end());
  return samples;
}

std::vector<ValueWithNeighbours> SharedArray::SamplesAbove(double value, long long most) const
{
  std::vector<double> here;
  this->VisitSamples(most,
    [&](int i, int j, int k, double sample)
    {
      if (sample > value)
      {
        const auto valueAt = [this](int x, int y, int z) { return this->ValueAt(x, y, z); };
        here.push_back(sample);
        here.push_back(EighthLargestNeighbour(this->Size, { { i, j, k } }, valueAt));
      }
    });
  const std::vector<double> all = this->Gathered(std::move(here));
  std::vector<ValueWithNeighbours> samples(all.size() / 2);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    samples[i] = { all[2 * i], all[2 * i + 1] };
  }
  // Sorted, so that sums are the same for any number of processes.
  std::sort(samples.begin(), samples.end(),
    [](const ValueWithNeighbours& a, const ValueWithNeighbours& b)
    { return std::tie(a.value, a.eighth) < std::tie(b.value, b.eighth); });
  return samples;
}

bool AnyProcess(vtkMultiProcessController* processes, bool here)
{
  int any = here ? 1 : 0;
  if (processes)
  {
    const int own = any;
    processes->AllReduce(&own, &any, 1, vtkCommunicator::MAX_OP);
  }
  return any != 0;
}
}
