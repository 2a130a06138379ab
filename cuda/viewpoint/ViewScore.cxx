// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/ViewScore.h"

#include "backend/ComputeBackend.h"
#include "energy/NodeImportance.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
/// Rays through the smallest side of what is not empty, at least. S is an integral over a picture;
/// few rays miss the outlines of what is in it, and by how much changes with every direction.
constexpr double fewestRays = 96.0 * 96.0;
constexpr double largestDensity = 16;

double DensityOf(const Int3& nodes, double atLeast)
{
  const Vec3 size = glm::max(Vec3(nodes), Vec3(2.0));
  const double smallest = size.x * size.y * size.z / std::max({ size.x, size.y, size.z });
  return std::max(atLeast, std::min(std::sqrt(fewestRays / smallest), largestDensity));
}
}

ViewScore::ViewScore(
  const Grid& grid, const ViewedFields& viewed, double rayDensity, BackendKind backend)
  : Fields(std::make_unique<ViewFields>(grid, viewed))
  , RayDensity(DensityOf(this->Fields->Nodes(), rayDensity))
  , Important(
      ImportantExtinction(grid, viewed.base ? viewed.base : viewed.extinction, viewed.importance))
{
  // The fields, twice; the rays of a direction take little.
  const Index nodes = this->Fields->InOrder().grid.NodeCount();
  const std::size_t fields = viewed.base ? 3 : 2;
  const BackendChoice choice =
    ChooseBackend(backend, { nodes, 2 * fields * sizeof(float) * static_cast<std::size_t>(nodes) });
  this->Name = choice.name;
  this->Sweep = BackendOf(choice.cuda).MakeScoreSweep(*this->Fields);
}

Score ViewScore::At(const Camera& camera) const
{
  return ScoreOf(
    this->Sweep->See(this->Fields->PartsOf(camera, this->RayDensity)), this->Important);
}

ViewSlope ViewScore::SlopeAt(const Camera& camera) const
{
  const Vec3 way = camera.focalPoint - camera.position;
  const double distance = glm::length(way);
  const Vec3 forward = way / distance;
  const Vec3 right =
    glm::normalize(glm::cross(forward, std::abs(forward.x) < 0.7 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  const EyeMoves by{ { right, glm::cross(right, forward) }, distance };
  const int cuts = std::max(1, static_cast<int>(std::lround(this->RayDensity)));

  ViewSlope result;
  for (ViewFields::Part& part : this->Fields->PartsOf(camera, this->RayDensity))
  {
    const ViewDerivative turn = this->Sweep->Differentiate(std::move(part), by, cuts);
    result.score += turn.score;
    result.slope += turn.slope[0] * by.moves[0] + turn.slope[1] * by.moves[1];
  }
  return result;
}
}
