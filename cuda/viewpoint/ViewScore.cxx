// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/ViewScore.h"

#include "backend/ComputeBackend.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
/// Minimum number of rays through the smallest side of the nonempty box. S is an integral over a
/// picture; few rays miss the outlines of structures, with an error that changes with the
/// direction.
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
{
  // Memory for two copies of the fields; the rays of a direction need little.
  const Index nodes = this->Fields->InOrder().grid.NodeCount();
  const std::size_t fields = (viewed.base ? 3 : 2) + (viewed.least ? 1 : 0);
  const BackendChoice choice =
    ChooseBackend(backend, { nodes, 2 * fields * sizeof(float) * static_cast<std::size_t>(nodes) });
  this->Name = this->Fields->Describe(choice.name);
  this->Sweep = BackendOf(choice.cuda).MakeScoreSweep(*this->Fields);
}

Score ViewScore::At(const Camera& camera) const
{
  return ScoreOf(this->Sweep->See(this->Fields->PartsOf(camera, this->RayDensity)),
    this->Fields->ImportantExtinction());
}

/// Computes the slope by differences between cameras on either side, on the sphere around the
/// focal point. Their distance is large enough that the positions of rays relative to nodes do not
/// matter.
ViewSlope ViewScore::DifferenceAt(const Camera& camera) const
{
  constexpr double angle = 0.03;
  const Vec3 out = camera.position - camera.focalPoint;
  const double distance = glm::length(out);
  const Vec3 right = glm::normalize(
    glm::cross(out, std::abs(out.x) < 0.7 * distance ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  ViewSlope result;
  result.score = this->At(camera).visibility;
  for (const Vec3& move : { right, glm::cross(right, out / distance) })
  {
    const auto scoreAt = [&](double turn)
    {
      Camera there = camera;
      there.position = camera.focalPoint + std::cos(turn) * out + std::sin(turn) * distance * move;
      return this->At(there).visibility;
    };
    result.slope += (scoreAt(angle) - scoreAt(-angle)) / (2 * std::sin(angle) * distance) * move;
  }
  return result;
}

ViewSlope ViewScore::SlopeAt(const Camera& camera) const
{
  if (this->Fields->InOrder().values.attainable)
  {
    return this->DifferenceAt(camera);
  }
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
