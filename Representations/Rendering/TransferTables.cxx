// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "TransferTables.h"

#include "AllCores.h"
#include "FunctionPieces.h"
#include "ScalarMapping.h"

#include "vtkColorTransferFunction.h"
#include "vtkPiecewiseFunction.h"
#include "vtkSmartPointer.h"
#include "vtkVolumeProperty.h"

#include "math/Require.h"
#include "render/Classification.h" // for TableAxis

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace limpid
{
namespace
{
constexpr int LeastSamples = 4096;
constexpr int MostSamples = 1 << 20;

struct ScalarRange
{
  double low = 0;
  double high = 0;

  // Returns one of `count` positions at equal steps.
  double At(int sample, int count) const
  {
    const double share = double(sample) / (count - 1);
    return this->low * (1 - share) + this->high * share; // a difference could overflow
  }
};

void Include(const double* range, FunctionRange& whole)
{
  whole.low = std::min(whole.low, range[0]);
  whole.high = std::max(whole.high, range[1]);
}

bool IsConstantOutside(vtkColorTransferFunction* function)
{
  return function->GetClamping() && !function->GetUseBelowRangeColor() &&
    !function->GetUseAboveRangeColor();
}

// Returns the interval to sample, which is not empty, and within the data if possible.
ScalarRange SampledRange(const FunctionRange& range, double low, double high)
{
  ScalarRange sampled{ low, high };
  if (range.constantOutside && range.low <= range.high)
  {
    sampled.low = std::min(std::max(low, range.low), range.high);
    sampled.high = std::max(std::min(high, range.high), range.low);
  }
  if (!(sampled.high > sampled.low))
  {
    // A table needs two values that single precision can distinguish.
    sampled.high = sampled.low + std::max(1e-3 * std::abs(sampled.low), 1e-30);
  }
  return sampled;
}

// Returns the distances between every node and the next but one within an interval: features of a
// function, such as steps and peaks, have such widths.
template <class Function>
double NarrowestFeature(Function* function, const ScalarRange& interval)
{
  double narrowest = interval.high - interval.low;
  double before[2] = { interval.low, interval.low };
  const int count = function->GetSize();
  for (int i = 0; i < count; ++i)
  {
    std::array<double, 6> node{}; // position, values, midpoint, sharpness
    function->GetNodeValue(i, node.data());
    const double inside = std::min(std::max(node[0], interval.low), interval.high);
    const double width = inside - before[0];
    narrowest = i > 1 && width > 0 ? std::min(narrowest, width) : narrowest;
    before[0] = before[1];
    before[1] = inside;
  }
  return narrowest;
}

// The sampling of a table.
struct Sampling
{
  int count;
  double featuresPerSample; ///< narrowest features per sample
};

Sampling SamplingOf(vtkVolumeProperty* property, const ScalarRange& interval, bool ofOpacity)
{
  constexpr double samplesPerFeature = 4;
  double feature = property->GetColorChannels(0) == 1
    ? NarrowestFeature(property->GetGrayTransferFunction(0), interval)
    : NarrowestFeature(property->GetRGBTransferFunction(0), interval);
  if (ofOpacity)
  {
    feature = std::min(feature, NarrowestFeature(property->GetScalarOpacity(0), interval));
  }
  const double width = interval.high - interval.low;
  const double wanted = std::ceil(samplesPerFeature * (width / feature)) + 1;
  Sampling sampling{};
  sampling.count = wanted > LeastSamples ? static_cast<int>(std::min(wanted, double(MostSamples)))
                                         : LeastSamples; // also if the ratio is NaN
  sampling.featuresPerSample = width / feature / (sampling.count - 1);
  return sampling;
}

FunctionPieces<vtkColorTransferFunction> PiecesOf(vtkColorTransferFunction* function)
{
  const auto newPiece = [function]
  {
    auto piece = vtkSmartPointer<vtkColorTransferFunction>::New();
    piece->SetClamping(function->GetClamping());
    piece->SetScale(function->GetScale());
    piece->SetColorSpace(function->GetColorSpace());
    piece->SetHSVWrap(function->GetHSVWrap());
    piece->SetNanColor(function->GetNanColor());
    piece->SetUseBelowRangeColor(function->GetUseBelowRangeColor());
    piece->SetBelowRangeColor(function->GetBelowRangeColor());
    piece->SetUseAboveRangeColor(function->GetUseAboveRangeColor());
    piece->SetAboveRangeColor(function->GetAboveRangeColor());
    piece->SetAllowDuplicateScalars(1); // two nodes may have the same position
    return piece;
  };
  const auto addNode = [](vtkColorTransferFunction* piece, const std::array<double, 6>& node)
  { piece->AddRGBPoint(node[0], node[1], node[2], node[3], node[4], node[5]); };
  return { function, newPiece, addNode };
}

// Like GetTable, but at equal steps for any scale of the function.
void SampleLogarithmicColors(
  vtkColorTransferFunction* function, const ScalarRange& interval, std::vector<double>& table)
{
  const double* range = function->GetRange();
  const FunctionPieces<vtkColorTransferFunction> pieces = PiecesOf(function);
  const auto count = static_cast<int>(table.size() / 3);
  for (int i = 0; i < count; ++i)
  {
    const double value = interval.At(i, count);
    const double inside =
      IsConstantOutside(function) ? std::min(std::max(value, range[0]), range[1]) : value;
    pieces.At(inside)->vtkColorTransferFunction::GetColor(inside, &table[3 * std::size_t(i)]);
  }
}

std::vector<double> ColorTable(vtkVolumeProperty* property, const ScalarRange& interval, int count)
{
  std::vector<double> table(3 * std::size_t(count), 0.0);
  if (property->GetColorChannels(0) == 1)
  {
    const ScalarMapping gray = Evaluate(property->GetGrayTransferFunction(0));
    for (std::size_t i = 0; i < table.size(); ++i)
    {
      table[i] = i % 3 == 0 ? gray(interval.At(static_cast<int>(i / 3), count)) : table[i - 1];
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
    function->GetTable(interval.low, interval.high, count, table.data());
  }
  return table;
}

float Color(double value)
{
  return std::isfinite(value) ? static_cast<float>(std::min(std::max(value, 0.0), 1.0)) : 0.0F;
}

// Returns functions with colours and without extinction.
TransferFunctions WithColors(
  vtkVolumeProperty* property, const ScalarRange& interval, int count, const ValueUnit& unit)
{
  const std::vector<double> colors = ColorTable(property, interval, count);
  TransferFunctions functions;
  functions.low = unit.Of(interval.low);
  functions.high = unit.Of(interval.high);
  functions.color.resize(std::size_t(count));
  for (std::size_t i = 0; i < functions.color.size(); ++i)
  {
    functions.color[i] = { { Color(colors[3 * i]), Color(colors[3 * i + 1]),
      Color(colors[3 * i + 2]) } };
  }
  return functions;
}

double FiniteExtinction(double opacity, double unitDistance)
{
  return ExtinctionOfOpacity(std::isfinite(opacity) ? opacity : 0.0, unitDistance);
}
}

FunctionRange RangeOfFunctions(vtkVolumeProperty* property, bool ofOpacity)
{
  FunctionRange range;
  if (property->GetColorChannels(0) == 1)
  {
    Include(property->GetGrayTransferFunction(0)->GetRange(), range);
    range.constantOutside = property->GetGrayTransferFunction(0)->GetClamping() != 0;
  }
  else
  {
    Include(property->GetRGBTransferFunction(0)->GetRange(), range);
    range.constantOutside = IsConstantOutside(property->GetRGBTransferFunction(0));
  }
  if (ofOpacity)
  {
    Include(property->GetScalarOpacity(0)->GetRange(), range);
    range.constantOutside &= property->GetScalarOpacity(0)->GetClamping() != 0;
  }
  return range;
}

TransferFunctions SampleFunctions(vtkVolumeProperty* property, double low, double high,
  const ValueUnit& unit, ExactExtinction& exact)
{
  constexpr double fewFeatures = 1.0 / 16; // per sample; with fewer, the table is almost exact
  const double unitDistance = property->GetScalarOpacityUnitDistance(0);
  LIMPID_REQUIRE(unitDistance > 0 && std::isfinite(unitDistance),
    "The scalar opacity unit distance is "
      << unitDistance
      << " (it is the distance over which opacities apply). Set a length above zero.");

  const ScalarRange interval = SampledRange(RangeOfFunctions(property, true), low, high);
  const Sampling sampling = SamplingOf(property, interval, true);
  TransferFunctions functions = WithColors(property, interval, sampling.count, unit);
  vtkPiecewiseFunction* opacity = property->GetScalarOpacity(0);
  const ScalarMapping opacityOf = Evaluate(opacity);
  functions.extinction.resize(functions.color.size());
  for (int i = 0; i < sampling.count; ++i)
  {
    functions.extinction[std::size_t(i)] =
      static_cast<float>(FiniteExtinction(opacityOf(interval.At(i, sampling.count)), unitDistance));
  }
  exact = {};
  if (opacity->GetUseLogScale() || !(sampling.featuresPerSample <= fewFeatures))
  {
    exact.ofValue = [opacityOf, unitDistance](double value)
    { return FiniteExtinction(opacityOf(value), unitDistance); };
    exact.time = opacity->GetMTime();
  }
  return functions;
}

TransferFunctions SampleColors(
  vtkVolumeProperty* property, double low, double high, const ValueUnit& unit, float extinction)
{
  const ScalarRange interval = SampledRange(RangeOfFunctions(property, false), low, high);
  const int count = SamplingOf(property, interval, false).count;
  TransferFunctions functions = WithColors(property, interval, count, unit);
  functions.extinction.assign(functions.color.size(), extinction);
  return functions;
}

float LargestExtinction(vtkVolumeProperty* property)
{
  return static_cast<float>(ExtinctionOfOpacity(
    LargestValue(property->GetScalarOpacity(0)), property->GetScalarOpacityUnitDistance(0)));
}

void LookUpExtinction(const TransferFunctions& functions, const ExactExtinction& exact,
  const ValueUnit& unit, const ScalarNodes& values, Index count, float* extinction)
{
  const TableAxis axis(functions.low, functions.high, functions.extinction.size());
  const float* entries = functions.extinction.data();
  const auto lookUp = [=](float value)
  {
    float share = 0;
    const int entry = axis.Split(axis.Inside(axis.Position(value)), share);
    return Blend(entries[entry], entries[entry + 1], share);
  };
  ForOnAllCores(count,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const float value = values.At(i);
        extinction[i] = std::isnan(value) ? 0.0F
          : exact.ofValue                 ? static_cast<float>(exact.ofValue(unit.Back(value)))
                                          : lookUp(value);
      }
    });
}
}
