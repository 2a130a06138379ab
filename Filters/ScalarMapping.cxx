// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ScalarMapping.h"

#include "AllCores.h"
#include "FunctionPieces.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkPiecewiseFunction.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

namespace limpid
{
namespace
{
struct Node
{
  double position;
  double value;
};

// Returns the nodes of a function that is piecewise linear and constant outside; empty for others.
std::vector<Node> NodesOfPlainFunction(vtkPiecewiseFunction* function)
{
  std::vector<Node> nodes;
  if (!function->GetClamping() || function->GetUseLogScale())
  {
    return nodes;
  }
  for (int i = 0; i < function->GetSize(); ++i)
  {
    std::array<double, 4> node; // position, value, midpoint, sharpness
    function->GetNodeValue(i, node.data());
    const bool straight = node[2] == 0.5 && node[3] == 0.0;
    const bool ascending = nodes.empty() || nodes.back().position < node[0];
    if (!straight || !ascending)
    {
      return {};
    }
    nodes.push_back({ node[0], node[1] });
  }
  return nodes;
}

FunctionPieces<vtkPiecewiseFunction> PiecesOf(vtkPiecewiseFunction* function)
{
  const auto newPiece = [function]
  {
    auto piece = vtkSmartPointer<vtkPiecewiseFunction>::New();
    piece->SetClamping(function->GetClamping());
    piece->SetUseLogScale(function->GetUseLogScale());
    piece->SetAllowDuplicateScalars(1); // two nodes may have the same position
    return piece;
  };
  const auto addNode = [](vtkPiecewiseFunction* piece, const std::array<double, 6>& node)
  { piece->AddPoint(node[0], node[1], node[2], node[3]); };
  return { function, newPiece, addNode };
}

double EvaluateNodes(const std::vector<Node>& nodes, double position)
{
  const auto next = std::upper_bound(nodes.begin(), nodes.end(), position,
    [](double wanted, const Node& node) { return wanted < node.position; });
  if (next == nodes.begin())
  {
    return nodes.front().value;
  }
  if (next == nodes.end())
  {
    return nodes.back().value;
  }
  const Node& left = *(next - 1);
  // Positions are halved, since their difference may overflow.
  const double share =
    (0.5 * position - 0.5 * left.position) / (0.5 * next->position - 0.5 * left.position);
  return left.value + share * (next->value - left.value);
}

template <class TupleRange>
double ValueOf(const TupleRange& tuple, int component)
{
  if (component != MagnitudeComponent)
  {
    return static_cast<double>(tuple[component]);
  }
  if (tuple.size() == 1)
  {
    return static_cast<double>(tuple[0]);
  }
  double sum = 0;
  for (const auto value : tuple)
  {
    sum += static_cast<double>(value) * static_cast<double>(value);
  }
  return std::sqrt(sum);
}

float MapValue(const ScalarMapping& mapping, double value)
{
  if (std::isfinite(value))
  {
    const auto mapped = static_cast<float>(mapping(value));
    if (std::isfinite(mapped))
    {
      return mapped;
    }
  }
  return std::numeric_limits<float>::quiet_NaN();
}

struct MapWorker
{
  TupleBox box;
  int component;
  const ScalarMapping& mapping;
  std::vector<float>& table; // of types of eight or sixteen bits: values of all numbers, made once
  float* field;

  template <class ArrayType>
  void operator()(ArrayType* array) const
  {
    using Value = vtk::GetAPIType<ArrayType>;
    constexpr bool isSmall = std::is_integral<Value>::value && sizeof(Value) <= 2;
    if constexpr (isSmall)
    {
      if (this->component != MagnitudeComponent || array->GetNumberOfComponents() == 1)
      {
        this->LookUp<Value>(array);
        return;
      }
    }
    this->Compute(array);
  }

  // For types of eight or sixteen bits, the mapping is evaluated once per possible value.
  template <class Value, class ArrayType>
  void LookUp(ArrayType* array) const
  {
    constexpr int highest = std::numeric_limits<Value>::max();
    constexpr int lowest = std::is_signed<Value>::value ? -highest - 1 : 0;
    for (int value = lowest; this->table.size() <= std::size_t(highest - lowest); ++value)
    {
      this->table.push_back(MapValue(this->mapping, value));
    }
    const float* values = this->table.data();
    const int chosen = std::max(this->component, 0);
    const auto tuples = vtk::DataArrayTupleRange(array);
    this->ForTuples(
      [&](vtkIdType tuple, float& out)
      {
        const int value = static_cast<int>(static_cast<Value>(tuples[tuple][chosen]));
        out = values[value - lowest];
      });
  }

  template <class ArrayType>
  void Compute(ArrayType* array) const
  {
    const auto tuples = vtk::DataArrayTupleRange(array);
    this->ForTuples([&](vtkIdType tuple, float& out)
      { out = MapValue(this->mapping, ValueOf(tuples[tuple], this->component)); });
  }

  // Calls map(tuple, value) for all tuples of the box.
  template <class Map>
  void ForTuples(const Map& map) const
  {
    const TupleBox of = this->box;
    ForOnAllCores(of.length * of.rows * of.layers,
      [&](vtkIdType begin, vtkIdType end)
      {
        while (begin < end)
        {
          const vtkIdType row = begin / of.length;
          const vtkIdType inRow = begin % of.length;
          const vtkIdType stop = std::min(end, begin + of.length - inRow);
          vtkIdType tuple =
            of.first + row / of.rows * of.toNextLayer + row % of.rows * of.toNextRow + inRow;
          for (; begin < stop; ++begin)
          {
            map(tuple++, this->field[begin]);
          }
        }
      });
  }
};

struct RangeWorker
{
  int component;
  double& low;
  double& high;

  template <class ArrayType>
  void operator()(ArrayType* array) const
  {
    using Value = vtk::GetAPIType<ArrayType>;
    std::mutex access;
    ForOnAllCores(array->GetNumberOfTuples(),
      [&](vtkIdType begin, vtkIdType end)
      {
        constexpr double infinite = std::numeric_limits<double>::infinity();
        std::pair<double, double> range{ infinite, -infinite };
        if (std::is_integral<Value>::value && array->GetNumberOfComponents() == 1)
        {
          range = RangeOfNumbers<Value>(array, begin, end);
        }
        else
        {
          this->Include(array, begin, end, range);
        }
        const std::lock_guard<std::mutex> lock(access);
        this->low = std::min(this->low, range.first);
        this->high = std::max(this->high, range.second);
      });
  }

private:
  // Numbers that are all finite, compared in their own type, which takes an eighth of the time.
  template <class Value, class ArrayType>
  static std::pair<double, double> RangeOfNumbers(ArrayType* array, vtkIdType begin, vtkIdType end)
  {
    Value least = std::numeric_limits<Value>::max();
    Value most = std::numeric_limits<Value>::lowest();
    for (const Value value : vtk::DataArrayValueRange<1>(array, begin, end))
    {
      least = std::min(least, value);
      most = std::max(most, value);
    }
    return { static_cast<double>(least), static_cast<double>(most) };
  }

  template <class ArrayType>
  void Include(
    ArrayType* array, vtkIdType begin, vtkIdType end, std::pair<double, double>& range) const
  {
    for (const auto tuple : vtk::DataArrayTupleRange(array, begin, end))
    {
      const double value = ValueOf(tuple, this->component);
      if (std::isfinite(value))
      {
        range.first = std::min(range.first, value);
        range.second = std::max(range.second, value);
      }
    }
  }
};

template <class Worker>
void Dispatch(vtkDataArray* array, const Worker& worker)
{
  using AllTypes = vtkArrayDispatch::DispatchByValueType<vtkArrayDispatch::AllTypes>;
  if (!AllTypes::Execute(array, worker))
  {
    worker(array); // other memory layouts are read through the virtual interface
  }
}
}

ScalarMapping KeepValue()
{
  return [](double value) { return value; };
}

ScalarMapping Evaluate(vtkPiecewiseFunction* function)
{
  std::vector<Node> nodes = NodesOfPlainFunction(function);
  if (nodes.empty())
  {
    const auto pieces =
      std::make_shared<const FunctionPieces<vtkPiecewiseFunction>>(PiecesOf(function));
    return [pieces](double value) { return pieces->At(value)->GetValue(value); };
  }
  return [nodes = std::move(nodes)](double value) { return EvaluateNodes(nodes, value); };
}

double LargestValue(vtkPiecewiseFunction* function)
{
  double largest = 0;
  for (int i = 0; i < function->GetSize(); ++i)
  {
    std::array<double, 4> node; // values between two nodes lie between theirs
    function->GetNodeValue(i, node.data());
    largest = std::isfinite(node[1]) ? std::max(largest, node[1]) : largest;
  }
  return largest;
}

ScalarMapping Ramp(double low, double high)
{
  if (!(high > low))
  {
    return [](double) { return 0.0; };
  }
  return [low, high](double value)
  { return std::min(std::max((value - low) / (high - low), 0.0), 1.0); };
}

double ExtinctionOfOpacity(double opacity, double unitDistance)
{
  const double clamped = std::min(std::max(opacity, 0.0), LargestOpacity);
  // log1p takes four times as long as log and is needed only where 1 - opacity loses digits.
  const double depth = clamped > 1e-6 ? -std::log(1.0 - clamped) : -std::log1p(-clamped);
  return depth / unitDistance;
}

void FiniteRange(vtkDataArray* array, int component, double& low, double& high)
{
  low = std::numeric_limits<double>::max();
  high = std::numeric_limits<double>::lowest();
  Dispatch(array, RangeWorker{ component, low, high });
}

void MapArray(vtkDataArray* array, int component, const ScalarMapping& mapping, float* field)
{
  TupleMapping(array, component, mapping).Fill({ 0, array->GetNumberOfTuples() }, field);
}

TupleMapping::TupleMapping(vtkDataArray* array, int component, ScalarMapping mapping)
  : Array(array)
  , Component(component)
  , Mapping(std::move(mapping))
{
}

void TupleMapping::Fill(const TupleBox& box, float* field)
{
  Dispatch(this->Array, MapWorker{ box, this->Component, this->Mapping, this->Table, field });
}
}
