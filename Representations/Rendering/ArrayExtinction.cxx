// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ArrayExtinction.h"

#include "AllCores.h"
#include "Blanking.h"
#include "Memory.h"
#include "SceneConversion.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"

#include "distributed/Communicator.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

namespace limpid
{
namespace
{
// Returns the smallest power of two that is at least a value, limited to those with a finite
// inverse.
float PowerOfTwoFor(float value)
{
  using Limits = std::numeric_limits<float>;
  int exponent = 0;
  const float mantissa = std::frexp(value, &exponent);
  exponent -= mantissa == 0.5F ? 1 : 0;
  exponent = std::min(std::max(exponent, Limits::min_exponent), Limits::max_exponent - 1);
  return std::ldexp(1.0F, exponent);
}
}

ArrayExtinction::ArrayExtinction(
  vtkImageData* image, const FieldSource& source, float* scalars, const Communicator& ranks)
{
  const vtkSmartPointer<vtkFloatArray> field = source.array
    ? ConvertField(image, source, "Extinction")
    : NewArray<vtkFloatArray>("Extinction", 0);
  const Blanking blanking(image);
  const std::vector<float> left = blanking.Shares(source.onCells);
  float* values = field->GetPointer(0);
  std::atomic<vtkIdType> invalid{ 0 };
  std::atomic<vtkIdType> negative{ 0 };
  ForOnAllCores(field->GetNumberOfTuples(),
    [&](vtkIdType begin, vtkIdType end)
    {
      vtkIdType invalidHere = 0;
      vtkIdType negativeHere = 0;
      for (vtkIdType point = begin; point < end; ++point)
      {
        const float share = left.empty() ? 1.0F : left[std::size_t(point)];
        const bool counts = share > 0 && !std::isnan(scalars[point]);
        const bool isNumber = !std::isnan(values[point]);
        const bool usable = isNumber && values[point] >= 0;
        invalidHere += counts && !isNumber ? 1 : 0;
        negativeHere += counts && isNumber && !usable ? 1 : 0;
        values[point] = usable ? share * values[point] : 0.0F;
        scalars[point] = usable ? scalars[point] : std::numeric_limits<float>::quiet_NaN();
      }
      invalid += invalidHere;
      negative += negativeHere;
    });
  this->invalidPoints = invalid;
  this->negativePoints = negative;

  this->shares.assign(values, values + field->GetNumberOfTuples());
  this->largest = std::accumulate(this->shares.begin(), this->shares.end(), 0.0F,
    [](float one, float other) { return std::max(one, other); });
  this->largest = ranks.LargestOf(this->largest);
  if (!(this->largest > 0))
  {
    return;
  }
  this->unit = PowerOfTwoFor(this->largest);
  const float perUnit = 1 / this->unit;
  std::transform(this->shares.begin(), this->shares.end(), this->shares.begin(),
    [perUnit](float extinction) { return extinction * perUnit; });
}
}
