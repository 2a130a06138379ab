// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// From the functions of a vtkVolumeProperty to the tables of the core.

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
/// How the values of an array become the numbers that the core works on, which have single
/// precision: (value - offset) * scale, no farther from 0 than `limit`.
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

/// The values between which transfer functions are not constant, and whether they are outside.
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

/// The range of the colours, and of the opacity if that counts, too.
FunctionRange RangeOfFunctions(vtkVolumeProperty* property, bool ofOpacity);

/// The extinction of values, where a table between its entries is not what the functions say.
struct ExactExtinction
{
  std::function<double(double)> ofValue; ///< [1/length]; empty: the table is near enough
  std::uint64_t time = 0;                ///< when the function was changed last
};

/**
 * Colour and extinction of the values from `low` to `high` of the data, sampled where the functions
 * are not constant. Colours are those of vtkColorTransferFunction::GetTable, which VTK's volume
 * mappers use, but on a logarithmic scale those of GetColor, as the legend has them: there GetTable
 * is not sampled at equal steps, and VTK's own volume mappers shift the colours.
 *
 * There are so many entries that nothing narrower than four of them is between the nodes of the
 * functions, up to a million. `exact`: becomes what the extinction is of values themselves.
 *
 * Throws when the unit distance makes no extinction of an opacity.
 */
TransferFunctions SampleFunctions(vtkVolumeProperty* property, double low, double high,
  const ValueUnit& unit, ExactExtinction& exact);

/// The colours alone, likewise, with the same extinction for all values [1/length].
TransferFunctions SampleColors(
  vtkVolumeProperty* property, double low, double high, const ValueUnit& unit, float extinction);

/// Largest extinction that the opacity function has anywhere, Eq. (25) [1/length].
float LargestExtinction(vtkVolumeProperty* property);

/// Extinction of `count` values, by the table, linear in between, or exactly; of NaN: zero
/// [1/length].
void LookUpExtinction(const TransferFunctions& functions, const ExactExtinction& exact,
  const ValueUnit& unit, const float* values, Index count, float* extinction);
}

#endif
