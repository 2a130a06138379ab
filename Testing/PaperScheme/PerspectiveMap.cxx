// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "PaperScheme/PerspectiveMap.h"

#include "math/Require.h"
#include "scene/Grid.h"

#include <algorithm>
#include <array>

namespace limpid::reference
{
namespace
{
/// The axis of the frame that is farthest from being parallel to `direction`.
Vec3 AxisAcross(const Vec3& direction)
{
  const Vec3 size = glm::abs(direction);
  if (size.y <= size.x && size.y <= size.z)
  {
    return Vec3(0, 1, 0);
  }
  return size.x <= size.z ? Vec3(1, 0, 0) : Vec3(0, 0, 1);
}

/// Corners of the box of the nodes, from the eye [normalised length].
std::array<Vec3, 8> CornersFromEye(const Grid& grid, const Vec3& eye)
{
  std::array<Vec3, 8> corners;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vec3 index((corner & 1) ? grid.nodes.x - 1 : 0, (corner & 2) ? grid.nodes.y - 1 : 0,
      (corner & 4) ? grid.nodes.z - 1 : 0);
    corners[corner] = (grid.PointToWorld(index) - eye) / grid.Radius();
  }
  return corners;
}

/// Cells for `samplesPerVoxel` samples per node distance over `extent` [index].
int CellsOver(const Vec3& extent, double samplesPerVoxel)
{
  return std::max(1, static_cast<int>(std::lround(glm::length(extent) * samplesPerVoxel)));
}
}

template <class Real>
PerspectiveMap<Real> LookAtBox(const Grid& grid, const Vec3& eye, double samplesPerVoxel)
{
  grid.Require();
  LIMPID_REQUIRE(samplesPerVoxel > 0,
    "The number of samples per voxel is " << samplesPerVoxel
                                          << " (a perspective grid needs at least one cell). "
                                             "Set it above zero.");
  const double radius = grid.Radius();
  const Vec3 toCentre = (grid.Centre() - eye) / radius;
  const double distance = glm::length(toCentre);
  LIMPID_REQUIRE(distance > 0,
    "The eye is at (" << eye.x << ", " << eye.y << ", " << eye.z
                      << "), the centre of the data (the paper's perspective grids have no "
                         "direction to look in there). Move the eye out of the data.");

  const Vec3 forward = toCentre / distance;
  const Vec3 right = glm::normalize(glm::cross(forward, AxisAcross(forward)));
  const Vec3 up = glm::cross(right, forward);

  const std::array<Vec3, 8> corners = CornersFromEye(grid, eye);
  double nearDepth = glm::dot(corners[0], forward);
  double farDepth = nearDepth;
  for (const Vec3& corner : corners)
  {
    nearDepth = std::min(nearDepth, glm::dot(corner, forward));
    farDepth = std::max(farDepth, glm::dot(corner, forward));
  }
  LIMPID_REQUIRE(nearDepth > 0,
    "The eye at (" << eye.x << ", " << eye.y << ", " << eye.z << ") has parts of the data "
                   << -nearDepth * radius
                   << " length units behind it (the paper's perspective grids only reach forward). "
                      "Move the eye farther out of the data.");

  double halfWidth = 0; // at depth 1
  double halfHeight = 0;
  for (const Vec3& corner : corners)
  {
    const double depth = glm::dot(corner, forward);
    halfWidth = std::max(halfWidth, std::abs(glm::dot(corner, right)) / depth);
    halfHeight = std::max(halfHeight, std::abs(glm::dot(corner, up)) / depth);
  }

  const Vec3 u = grid.DirectionToIndex(right * halfWidth * radius);
  const Vec3 v = grid.DirectionToIndex(up * halfHeight * radius);
  const Vec3 w = grid.DirectionToIndex(forward * radius);

  PerspectiveMap<Real> map;
  map.origin = Vec3Of<Real>(grid.PointToIndex(eye));
  map.SetFrame(Vec3Of<Real>(u), Vec3Of<Real>(v), Vec3Of<Real>(w));
  map.unit = Vec3Of<Real>(grid.spacing / radius);
  map.nearDepth = Real(nearDepth);
  map.farDepth = Real(farDepth);
  map.cells.x = CellsOver(u * (2 * distance), samplesPerVoxel);
  map.cells.y = CellsOver(v * (2 * distance), samplesPerVoxel);
  map.cells.z = CellsOver(w * (farDepth - nearDepth), samplesPerVoxel);
  return map;
}

template PerspectiveMap<float> LookAtBox(const Grid&, const Vec3&, double);
template PerspectiveMap<double> LookAtBox(const Grid&, const Vec3&, double);
}
