// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "scene/Grid.h"

#include "math/Require.h"
#include "scene/ImageGrid.h"

#include <cmath>

namespace limpid
{
Vec3 Grid::PointToIndex(const Vec3& world) const
{
  return this->DirectionToIndex(world - this->origin);
}

Vec3 Grid::PointToWorld(const Vec3& index) const
{
  return this->origin + this->direction * (index * this->spacing);
}

Vec3 Grid::DirectionToIndex(const Vec3& world) const
{
  return (glm::transpose(this->direction) * world) / this->spacing;
}

Vec3 Grid::Centre() const
{
  return this->PointToWorld(0.5 * (Vec3(this->nodes) - 1.0));
}

double Grid::Radius() const
{
  return 0.5 * glm::length((Vec3(this->nodes) - 1.0) * this->spacing);
}

bool Grid::HasSameBox(const Grid& other) const
{
  const double tolerance = 1e-4 * this->Radius();
  const Vec3 first = other.PointToWorld(Vec3(0.0)) - this->PointToWorld(Vec3(0.0));
  const Vec3 last =
    other.PointToWorld(Vec3(other.nodes - 1)) - this->PointToWorld(Vec3(this->nodes - 1));
  return glm::length(first) <= tolerance && glm::length(last) <= tolerance;
}

void Grid::Require() const
{
  LIMPID_REQUIRE(this->nodes.x > 0 && this->nodes.y > 0 && this->nodes.z > 0,
    "The image has " << this->nodes.x << " x " << this->nodes.y << " x " << this->nodes.z
                     << " points (there is nothing to optimise). Give an image with points.");
  for (int axis = 0; axis < 3; ++axis)
  {
    LIMPID_REQUIRE(std::isfinite(this->spacing[axis]) && this->spacing[axis] > 0,
      "The spacing along axis "
        << axis << " is " << this->spacing[axis]
        << " (lengths along rays are computed from it). Set a spacing above zero.");
    LIMPID_REQUIRE(this->spacing[axis] >= leastLength && this->spacing[axis] <= mostLength,
      "The spacing along axis " << axis << " is " << this->spacing[axis]
                                << " (lengths and extinctions are computed in single precision, "
                                   "which supports spacings from "
                                << leastLength << " to " << mostLength
                                << "). Give lengths in another unit.");
    LIMPID_REQUIRE(std::isfinite(this->origin[axis]),
      "The origin along axis "
        << axis << " is " << this->origin[axis]
        << " (the position of the image is undefined). Set a finite origin.");
  }
  const double distance = DistanceFromOrthonormal(this->direction);
  LIMPID_REQUIRE(distance < 1e-6,
    "The direction matrix is not orthonormal, by "
      << distance << " (sheared images are not supported; only rounding errors, " << mostRounding
      << " at most, are corrected). Resample it to an orthonormal image.");
}
}
