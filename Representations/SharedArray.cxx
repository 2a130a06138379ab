// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SharedArray.h"

#include "vtkCommunicator.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMultiProcessController.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace limpid
{
SharedArray::SharedArray(vtkDataArray* array, vtkImageData* image, bool onCells,
  const int wholeExtent[6], vtkMultiProcessController* processes)
  : Array(array)
  , Processes(processes)
{
  const int* here = image->GetExtent();
  const int* whole = processes ? wholeExtent : here;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto at = static_cast<std::size_t>(axis);
    const int cells = onCells ? 1 : 0;
    const int end = here[2 * axis + 1];
    const auto sizeOf = [cells](int first, int last)
    { return std::max(last - first + 1 - cells, last >= first ? 1 : 0); };
    this->First[at] = here[2 * axis] - whole[2 * axis];
    this->Size[at] = sizeOf(here[2 * axis], end);
    this->Whole[at] = sizeOf(whole[2 * axis], whole[2 * axis + 1]);
    // Neighbours have the points between them both.
    const bool isLast = onCells || end == whole[2 * axis + 1];
    this->Own[at] = this->Size[at] - (isLast ? 0 : 1);
  }
}

std::array<double, 2> SharedArray::FiniteRange() const
{
  constexpr double most = std::numeric_limits<double>::max();
  std::array<double, 2> range{ { most, -most } };
  if (this->Array)
  {
    this->Array->GetFiniteRange(range.data(), this->Array->GetNumberOfComponents() > 1 ? -1 : 0);
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

double SharedArray::ValueAt(long long tuple) const
{
  const int components = this->Array->GetNumberOfComponents();
  if (components == 1)
  {
    return this->Array->GetComponent(tuple, 0);
  }
  double value = 0;
  for (int component = 0; component < components; ++component)
  {
    value = std::hypot(value, this->Array->GetComponent(tuple, component));
  }
  return value;
}

std::vector<double> SharedArray::SamplesHere(long long most) const
{
  std::vector<double> samples;
  if (!this->Array)
  {
    return samples;
  }
  using Number = long long;
  const std::array<int, 3>& whole = this->Whole;
  const Number tuples = Number(whole[0]) * whole[1] * whole[2];
  const Number step = std::max<Number>(1, tuples / most) | 1; // odd: meets all columns
  for (int k = 0; k < this->Own[2]; ++k)
  {
    for (int j = 0; j < this->Own[1]; ++j)
    {
      const Number row =
        (Number(k + this->First[2]) * whole[1] + j + this->First[1]) * whole[0] + this->First[0];
      const Number before = row % step;
      for (Number i = before == 0 ? 0 : step - before; i < this->Own[0]; i += step)
      {
        const double value = this->ValueAt((Number(k) * this->Size[1] + j) * this->Size[0] + i);
        if (std::isfinite(value))
        {
          samples.push_back(value);
        }
      }
    }
  }
  return samples;
}

std::vector<double> SharedArray::Samples(long long most) const
{
  std::vector<double> samples = this->SamplesHere(most);
  if (this->Processes)
  {
    const vtkIdType count = static_cast<vtkIdType>(samples.size());
    std::vector<vtkIdType> counts(
      static_cast<std::size_t>(this->Processes->GetNumberOfProcesses()));
    this->Processes->AllGather(&count, counts.data(), 1);
    std::vector<vtkIdType> begins(counts.size() + 1, 0);
    std::partial_sum(counts.begin(), counts.end(), begins.begin() + 1);
    std::vector<double> all(static_cast<std::size_t>(begins.back()));
    this->Processes->AllGatherV(samples.data(), all.data(), count, counts.data(), begins.data());
    samples = std::move(all);
  }
  std::sort(samples.begin(), samples.end());
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
