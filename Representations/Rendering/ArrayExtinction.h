// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A base extinction from an array instead of the transfer function.

#ifndef limpid_ArrayExtinction_h
#define limpid_ArrayExtinction_h

#include "vtkType.h"

#include <vector>

class vtkImageData;

namespace limpid
{
class Communicator;
struct FieldSource;

/**
 * An array of extinctions in the form that the core draws: a transfer function with the same
 * extinction for all scalars, and the share of it at each point. Shares are interpolated like
 * scalars, so a sample has the interpolated extinction; its colour comes from the transfer
 * function.
 */
struct ArrayExtinction
{
  /// The unit of the transfer function: a power of two not below any value, so that shares and
  /// their products with it are exact. Zero if nothing has extinction [1/length].
  float unit = 0;

  float largest = 0;         ///< largest value of the array, the majorant of Eq. (25) [1/length]
  std::vector<float> shares; ///< shares of `unit` at the points [0, 1]
  vtkIdType invalidPoints = 0;
  vtkIdType negativePoints = 0;

  /// `scalars`: at the points of the image; set to NaN, which is empty, where the extinction is
  /// NaN, infinite or negative. Points that were empty before are not counted. `ranks`: that share
  /// the image; some may have no points and no array.
  ArrayExtinction(
    vtkImageData* image, const FieldSource& source, float* scalars, const Communicator& ranks);
};
}

#endif
