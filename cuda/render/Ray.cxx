// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/Ray.h"

#include "math/Require.h"
#include "scene/GridMatrix.h"

#include <cmath>

namespace limpid
{
void RequireView(const View& view)
{
  bool finite = true;
  for (int column = 0; column < 4; ++column)
  {
    for (int row = 0; row < 4; ++row)
    {
      finite &= std::isfinite(view.clipToWorld[column][row]);
    }
  }
  LIMPID_REQUIRE(finite && glm::determinant(view.clipToWorld) != 0,
    "The view's matrix is singular or not finite (pixels cannot be mapped to rays). Check the "
    "camera: position, focal point, clipping range.");
  LIMPID_REQUIRE(view.sampleDistance > 0 && std::isfinite(view.sampleDistance),
    "The sample distance is " << view.sampleDistance
                              << " (rays would not advance). Set a number above zero.");
  LIMPID_REQUIRE(view.opaqueBelow >= 0 && view.opaqueBelow < 1,
    "Rays are terminated below the transmittance "
      << view.opaqueBelow
      << " (transmittance starts at 1 and decreases towards 0). Set a number from 0 to below 1.");
  LIMPID_REQUIRE(view.planes.size() <= std::size_t(RayMaker::mostPlanes),
    "There are " << view.planes.size()
                 << " clipping planes, counting a crop box as 6 (rays are clipped by at most "
                 << RayMaker::mostPlanes << "). Remove some.");
}

RayMaker::RayMaker(const Grid& grid, double stepLength, const View& view)
  : Direction(grid.direction)
  , Spacing(grid.spacing)
  , Origin(grid.origin)
  , Centre(grid.Centre())
  , LastNode(grid.nodes - 1)
  , PerRadius(1 / grid.Radius())
  , StepLength(stepLength)
  , Width(view.width)
  , Height(view.height)
  , Jitter(view.jitter)
{
  const glm::dmat4 worldToIndex = WorldToIndex(grid);
  this->ClipToIndex = worldToIndex * view.clipToWorld;
  const glm::dmat4 indexToWorld = glm::inverse(worldToIndex);
  for (const glm::dvec4& plane : view.planes)
  {
    this->Planes[this->PlaneCount++] = plane * indexToWorld;
  }
}
}
