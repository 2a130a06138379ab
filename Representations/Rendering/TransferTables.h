// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Converts the functions of a vtkVolumeProperty to the tables of the core.

#ifndef limpid_TransferTables_h
#define limpid_TransferTables_h

#include "render/Renderer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

class vtkVolumeProperty;

namespace limpid
{
/// Maps values of an array to the core's numbers, which have single precision: (value - offset) *
/// scale, clamped to [-limit, limit].
struct ValueUnit
{
  double offset = 0;
  double scale = 1;
  double limit = std::numeric_limits<double>::infinity();

  bool IsPlain() const { return this->offset == 0 && this->scale == 1 && std::isinf(this->limit); }

  double Of(double value) const
  {
    const double number = (value - this->offset) * this->scale;
    return std::min(std::max(number, -this->limit), this->limit);
  }

  double Back(double number) const { return number / this->scale + this->offset; }
};

/// The range of values outside which transfer functions are constant.
struct FunctionRange
{
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  bool constantOutside = true;

  bool operator==(const FunctionRange& other) const
  {
    return this->low == other.low && this->high == other.high &&
      this->constantOutside == other.constantOutside;
  }
};

/// Returns the range of the colours and, if it is used, of the opacity.
FunctionRange RangeOfFunctions(vtkVolumeProperty* property, bool ofOpacity);

/// The exact extinction of values, used if the linearly interpolated table deviates from the
/// functions.
struct ExactExtinction
{
  std::function<double(double)> ofValue; ///< [1/length]; empty: the table is accurate enough
  std::uint64_t time = 0;                ///< modification time of the function
};

/**
 * Samples colour and extinction for values of the data from `low` to `high`, where the functions
 * are not constant. Colours are those of vtkColorTransferFunction::GetTable, which VTK's volume
 * mappers use. On a logarithmic scale, they are those of GetColor, as in the legend: there GetTable
 * does not sample at equal steps, and VTK's own volume mappers shift the colours.
 *
 * The number of entries, up to a million, is such that nodes of the functions are at least four
 * entries apart. `exact`: set to the exact extinction of values.
 *
 * Throws if the unit distance gives no valid extinction for an opacity.
 */
TransferFunctions SampleFunctions(vtkVolumeProperty* property, double low, double high,
  const ValueUnit& unit, ExactExtinction& exact);

/// Samples only the colours in this way, with the same extinction for all values [1/length].
TransferFunctions SampleColors(
  vtkVolumeProperty* property, double low, double high, const ValueUnit& unit, float extinction);

/// Returns the largest extinction of the opacity function over all values, Eq. (25) [1/length].
float LargestExtinction(vtkVolumeProperty* property);

/// Computes the extinction of the first `count` values, by linear interpolation in the table or
/// exactly; zero for NaN [1/length].
void LookUpExtinction(const TransferFunctions& functions, const ExactExtinction& exact,
  const ValueUnit& unit, const ScalarNodes& values, Index count, float* extinction);
}

#endif
