// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A base extinction that is not the transfer function's.

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
 * An array of extinctions as the core draws it: a transfer function that has the same extinction
 * for all scalars, and the share of it at each point. Shares are interpolated like scalars, so a
 * sample has the interpolated extinction, and the transfer function gives it its colour.
 */
struct ArrayExtinction
{
  /// The unit of the transfer function: a power of two not below any value, so that shares and
  /// their products with it are exact. Zero if nothing has extinction [1/length].
  float unit = 0;

  float largest = 0;         ///< of the array, the majorant of Eq. (25) [1/length]
  std::vector<float> shares; ///< at each point [0, 1]
  vtkIdType invalidPoints = 0;
  vtkIdType negativePoints = 0;

  /// `scalars`: at the points of the image. Points with a NaN, an infinite or a negative extinction
  /// become empty there; those that are so already are not counted. `ranks`: that share the image,
  /// of which some may have no points and no array; null: there is one.
  ArrayExtinction(vtkImageData* image, const FieldSource& source, float* scalars,
    const Communicator* ranks = nullptr);
};
}

#endif
