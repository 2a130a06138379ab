// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Conversion of array values to field values: transfer functions and their application.

#ifndef limpid_ScalarMapping_h
#define limpid_ScalarMapping_h

#include "vtkLimpidFiltersModule.h" // for export macro
#include "vtkType.h"

#include <functional>
#include <vector>

class vtkDataArray;
class vtkPiecewiseFunction;

namespace limpid
{
/// A function of one variable in double precision. The argument is finite.
using ScalarMapping = std::function<double(double)>;

/// The component that stands for the magnitude of the tuple; for a single component, for its value.
constexpr int MagnitudeComponent = -1;

/// The largest opacity that is converted to extinction. -ln(1 - opacity) is infinite at 1; here it
/// is 13.8, so that one unit distance transmits one millionth of the light. That is far below a
/// step of an 8-bit picture (1/255), and far above the rounding of single precision (6e-8), where 1
/// - exp(-x) would be 1 again.
constexpr double LargestOpacity = 1.0 - 1e-6;

/// Returns the identity.
VTKLIMPIDFILTERS_EXPORT ScalarMapping KeepValue();

/// Returns the mapping by a function of one variable, as by vtkPiecewiseFunction::GetValue.
VTKLIMPIDFILTERS_EXPORT ScalarMapping Evaluate(vtkPiecewiseFunction* function);

/// Returns the largest finite value of a function of one variable over all arguments; 0 if it has
/// none.
VTKLIMPIDFILTERS_EXPORT double LargestValue(vtkPiecewiseFunction* function);

/// Returns a linear ramp from 0 at `low` to 1 at `high`, clamped.
VTKLIMPIDFILTERS_EXPORT ScalarMapping Ramp(double low, double high);

/// Returns the extinction of a medium that absorbs the share `opacity` of the light over
/// `unitDistance` [1/length]: -ln(1 - opacity) / unitDistance, the inverse of VTK's correction of
/// opacities for the sample distance. The opacity is clamped to [0, LargestOpacity]. The base
/// extinction of filters and mapper is computed here.
VTKLIMPIDFILTERS_EXPORT double ExtinctionOfOpacity(double opacity, double unitDistance);

/// Computes the smallest and largest finite value of a component; low > high if there is none.
VTKLIMPIDFILTERS_EXPORT void FiniteRange(
  vtkDataArray* array, int component, double& low, double& high);

/**
 * Writes mapping(component of the tuple) for every tuple to `field`. A value that is not finite
 * before or after the mapping becomes NaN.
 */
VTKLIMPIDFILTERS_EXPORT void MapArray(
  vtkDataArray* array, int component, const ScalarMapping& mapping, float* field);

/// Some tuples of an array: rows of consecutive ones in layers.
struct TupleBox
{
  vtkIdType first;    ///< tuple
  vtkIdType length;   ///< of a row
  vtkIdType rows = 1; ///< of a layer
  vtkIdType layers = 1;
  vtkIdType toNextRow = 0;
  vtkIdType toNextLayer = 0;
};

/// Does this for some tuples again and again.
class TupleMapping
{
public:
  /// The array must outlive this object.
  TupleMapping(vtkDataArray* array, int component, ScalarMapping mapping);

  /// Writes the values of a box, row by row.
  void Fill(const TupleBox& box, float* field);

private:
  vtkDataArray* Array;
  int Component;
  ScalarMapping Mapping;
  std::vector<float> Table; ///< see MapWorker
};
}

#endif
