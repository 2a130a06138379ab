// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// From the functions of a vtkVolumeProperty to the tables of the core.

#ifndef limpid_TransferTables_h
#define limpid_TransferTables_h

#include "render/Renderer.h"

class vtkVolumeProperty;

namespace limpid
{
/// How the values of an array become the numbers that the core works on, which have single
/// precision: (value - offset) * scale.
struct ValueUnit
{
  double offset = 0;
  double scale = 1;
};

/**
 * Colour and extinction of the values from `low` to `high` of the data, sampled where the functions
 * are not constant. Colours are those of vtkColorTransferFunction::GetTable, which VTK's volume
 * mappers use, but on a logarithmic scale those of GetColor, as the legend has them: there GetTable
 * is not sampled at equal steps, and VTK's own volume mappers shift the colours.
 *
 * Throws when the unit distance makes no extinction of an opacity.
 */
TransferFunctions SampleFunctions(
  vtkVolumeProperty* property, double low, double high, const ValueUnit& unit);

/// The colours alone, likewise, with the same extinction for all values [1/length].
TransferFunctions SampleColors(
  vtkVolumeProperty* property, double low, double high, const ValueUnit& unit, float extinction);

/// Largest extinction that the opacity function has anywhere, Eq. (25) [1/length].
float LargestExtinction(vtkVolumeProperty* property);

/// Extinction of `count` values by the table, linear in between; of NaN: zero [1/length].
void LookUpExtinction(
  const TransferFunctions& functions, const float* values, Index count, float* extinction);
}

#endif
