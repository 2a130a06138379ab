// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "TransferTables.h"

#include "AllCores.h"
#include "ScalarMapping.h"

#include "vtkColorTransferFunction.h"
#include "vtkPiecewiseFunction.h"
#include "vtkVolumeProperty.h"

#include "math/Require.h"
#include "render/Classification.h" // for TableAxis

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpid
{
namespace
{
constexpr int Samples = 4096;

struct ScalarRange
{
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();

  void Include(const double* range)
  {
    this->low = std::min(this->low, range[0]);
    this->high = std::max(this->high, range[1]);
  }
};

bool IsConstantOutside(vtkColorTransferFunction* function)
{
  return function->GetClamping() && !function->GetUseBelowRangeColor() &&
    !function->GetUseAboveRangeColor();
}

// Where functions are not constant, and whether they are constant outside of it.
struct FunctionRange
{
  ScalarRange interval;
  bool constantOutside = true;
};

FunctionRange RangeOfColors(vtkVolumeProperty* property)
{
  FunctionRange range;
  if (property->GetColorChannels(0) == 1)
  {
    range.interval.Include(property->GetGrayTransferFunction(0)->GetRange());
    range.constantOutside = property->GetGrayTransferFunction(0)->GetClamping() != 0;
  }
  else
  {
    range.interval.Include(property->GetRGBTransferFunction(0)->GetRange());
    range.constantOutside = IsConstantOutside(property->GetRGBTransferFunction(0));
  }
  return range;
}

FunctionRange RangeOfFunctions(vtkVolumeProperty* property)
{
  FunctionRange range = RangeOfColors(property);
  range.interval.Include(property->GetScalarOpacity(0)->GetRange());
  range.constantOutside &= property->GetScalarOpacity(0)->GetClamping() != 0;
  return range;
}

// An interval to be sampled: never empty, and within the data unless that makes it so.
ScalarRange SampledRange(const FunctionRange& range, double low, double high)
{
  const ScalarRange& functions = range.interval;
  ScalarRange sampled;
  sampled.low = low;
  sampled.high = high;
  if (range.constantOutside && functions.low <= functions.high)
  {
    sampled.low = std::min(std::max(low, functions.low), functions.high);
    sampled.high = std::max(std::min(high, functions.high), functions.low);
  }
  if (!(sampled.high > sampled.low))
  {
    // One value: a table needs two, and single precision must tell them apart.
    sampled.high = sampled.low + std::max(1e-3 * std::abs(sampled.low), 1e-30);
  }
  return sampled;
}

// As GetTable, but at equal steps whatever the scale of the function.
void SampleLogarithmicColors(
  vtkColorTransferFunction* function, const ScalarRange& interval, std::vector<double>& table)
{
  const double* range = function->GetRange();
  for (int i = 0; i < Samples; ++i)
  {
    const double value = interval.low + (interval.high - interval.low) * i / (Samples - 1);
    const double inside =
      IsConstantOutside(function) ? std::min(std::max(value, range[0]), range[1]) : value;
    function->vtkColorTransferFunction::GetColor(inside, &table[3 * std::size_t(i)]);
  }
}

std::vector<double> ColorTable(vtkVolumeProperty* property, const ScalarRange& interval)
{
  std::vector<double> table(3 * Samples, 0.0);
  if (property->GetColorChannels(0) == 1)
  {
    std::vector<double> gray(Samples);
    property->GetGrayTransferFunction(0)->GetTable(
      interval.low, interval.high, Samples, gray.data());
    for (std::size_t i = 0; i < table.size(); ++i)
    {
      table[i] = gray[i / 3];
    }
    return table;
  }
  vtkColorTransferFunction* function = property->GetRGBTransferFunction(0);
  if (function->GetScale() == VTK_CTF_LOG10 && function->GetRange()[0] > 0)
  {
    SampleLogarithmicColors(function, interval, table);
  }
  else
  {
    function->GetTable(interval.low, interval.high, Samples, table.data());
  }
  return table;
}

float Color(double value)
{
  return std::isfinite(value) ? static_cast<float>(std::min(std::max(value, 0.0), 1.0)) : 0.0F;
}

// Functions without extinction yet.
TransferFunctions WithColors(
  vtkVolumeProperty* property, const ScalarRange& interval, const ValueUnit& unit)
{
  const std::vector<double> colors = ColorTable(property, interval);
  TransferFunctions functions;
  functions.low = (interval.low - unit.offset) * unit.scale;
  functions.high = (interval.high - unit.offset) * unit.scale;
  functions.color.resize(Samples);
  for (std::size_t i = 0; i < Samples; ++i)
  {
    functions.color[i] = { { Color(colors[3 * i]), Color(colors[3 * i + 1]),
      Color(colors[3 * i + 2]) } };
  }
  return functions;
}
}

TransferFunctions SampleFunctions(
  vtkVolumeProperty* property, double low, double high, const ValueUnit& unit)
{
  const double unitDistance = property->GetScalarOpacityUnitDistance(0);
  LIMPID_REQUIRE(unitDistance > 0 && std::isfinite(unitDistance),
    "The scalar opacity unit distance is "
      << unitDistance << " (opacity is light lost on a distance). Set a length above zero.");

  const ScalarRange interval = SampledRange(RangeOfFunctions(property), low, high);
  TransferFunctions functions = WithColors(property, interval, unit);
  std::vector<double> opacities(Samples);
  property->GetScalarOpacity(0)->GetTable(interval.low, interval.high, Samples, opacities.data());
  functions.extinction.resize(Samples);
  for (std::size_t i = 0; i < Samples; ++i)
  {
    const double opacity = std::isfinite(opacities[i]) ? opacities[i] : 0.0;
    functions.extinction[i] = static_cast<float>(ExtinctionOfOpacity(opacity, unitDistance));
  }
  return functions;
}

TransferFunctions SampleColors(
  vtkVolumeProperty* property, double low, double high, const ValueUnit& unit, float extinction)
{
  const ScalarRange interval = SampledRange(RangeOfColors(property), low, high);
  TransferFunctions functions = WithColors(property, interval, unit);
  functions.extinction.assign(Samples, extinction);
  return functions;
}

float LargestExtinction(vtkVolumeProperty* property)
{
  return static_cast<float>(ExtinctionOfOpacity(
    LargestValue(property->GetScalarOpacity(0)), property->GetScalarOpacityUnitDistance(0)));
}

void LookUpExtinction(
  const TransferFunctions& functions, const float* values, Index count, float* extinction)
{
  const TableAxis axis(functions.low, functions.high, functions.extinction.size());
  const float* entries = functions.extinction.data();
  ForOnAllCores(count,
    [=](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        float share = 0;
        const int entry = axis.Split(axis.Inside(axis.Position(values[i])), share);
        const float there = Blend(entries[entry], entries[entry + 1], share);
        extinction[i] = std::isnan(values[i]) ? 0.0F : there;
      }
    });
}
}
