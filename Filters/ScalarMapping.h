// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How the values of an array become the values of a field: transfer functions and their use.

#ifndef limpid_ScalarMapping_h
#define limpid_ScalarMapping_h

#include "vtkLimpidFiltersModule.h" // for export macro

#include <functional>

class vtkDataArray;
class vtkPiecewiseFunction;

namespace limpid
{
/// A number for a number, in double precision. The argument is finite.
using ScalarMapping = std::function<double(double)>;

/// Component that stands for the length of the tuple; of a single component, for its value.
constexpr int MagnitudeComponent = -1;

/// Largest opacity that has an extinction. -ln(1 - opacity) is infinite at 1; here it is 13.8, so
/// one unit distance lets a millionth of the light through: far below a step of an 8-bit picture
/// (1/255), far above the rounding of single precision (6e-8), where 1 - exp(-x) would be 1 again.
constexpr double LargestOpacity = 1.0 - 1e-6;

/// The value itself.
VTKLIMPIDFILTERS_EXPORT ScalarMapping KeepValue();

/// The value of a function of one variable, as vtkPiecewiseFunction::GetValue has it.
VTKLIMPIDFILTERS_EXPORT ScalarMapping Evaluate(vtkPiecewiseFunction* function);

/// Largest finite value of a function of one variable, wherever it has it; 0 if it has none.
VTKLIMPIDFILTERS_EXPORT double LargestValue(vtkPiecewiseFunction* function);

/// A straight line from 0 at `low` to 1 at `high`, clamped.
VTKLIMPIDFILTERS_EXPORT ScalarMapping Ramp(double low, double high);

/// Extinction of what takes `opacity` of the light on `unitDistance`: -ln(1 - opacity) / distance,
/// the inverse of VTK's correction of opacities for the length of a step [1/length]. The opacity is
/// moved into [0, LargestOpacity]. Filters and mapper have their base extinction from here.
VTKLIMPIDFILTERS_EXPORT double ExtinctionOfOpacity(double opacity, double unitDistance);

/// Smallest and largest finite value of a component; low > high when there is none.
VTKLIMPIDFILTERS_EXPORT void FiniteRange(
  vtkDataArray* array, int component, double& low, double& high);

/**
 * Writes one value per tuple, mapping(component of the tuple), to `field`. A value that is not
 * finite, before or after the mapping, becomes NaN.
 */
VTKLIMPIDFILTERS_EXPORT void MapArray(
  vtkDataArray* array, int component, const ScalarMapping& mapping, float* field);
}

#endif
