// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The points of the importance function that the data suggest.

#ifndef limpid_ImportancePoints_h
#define limpid_ImportancePoints_h

#include "scene/StartingImportance.h"

#include <cstddef>
#include <vector>

namespace limpid
{
/**
 * Returns points of a piecewise function (value, importance, midpoint, sharpness) that rises from 0
 * to 1 between the inner two of four values (the property SuggestedImportance), and extends to the
 * outer two if these are farther out. Empty if the inner two are not in ascending order.
 */
inline std::vector<double> ImportancePoints(const std::vector<double>& suggested)
{
  std::vector<double> points;
  if (suggested.size() != 4 || !(suggested[1] < suggested[2]))
  {
    return points;
  }
  for (std::size_t i = 0; i < 4; ++i)
  {
    const bool isInner = i == 1 || i == 2;
    if (isInner || suggested[i] < suggested[1] || suggested[i] > suggested[2])
    {
      points.insert(points.end(), { suggested[i], i < 2 ? 0. : 1., 0.5, 0 });
    }
  }
  return points;
}
}

#endif
