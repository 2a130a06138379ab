// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_SceneFunctions_h
#define limpid_testing_SceneFunctions_h

#include "SceneFile.h"

#include "render/Renderer.h"

namespace limpid
{
/// The transfer functions of a scene file as the renderer takes them, in 1025 samples.
inline TransferFunctions FunctionsOf(const truth::SceneFile& file)
{
  TransferFunctions functions;
  functions.low = file.extinctionPoints.front().first;
  functions.high = file.extinctionPoints.back().first;
  const int last = 1024;
  for (int entry = 0; entry <= last; ++entry)
  {
    const double scalar = functions.low + (functions.high - functions.low) * entry / last;
    functions.extinction.push_back(float(truth::PiecewiseLinear(file.extinctionPoints, scalar)));
    const std::array<double, 3> color = file.Color(scalar);
    functions.color.push_back({ { float(color[0]), float(color[1]), float(color[2]) } });
  }
  return functions;
}
}

#endif
