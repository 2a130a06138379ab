// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/ViewScore.h"

#include "backend/ComputeBackend.h"
#include "distributed/Neighbourhood.h"
#include "distributed/Slab.h"
#include "energy/NodeImportance.h"

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

namespace
{
/// Sums over all ranks; rows of slabs are complete.
double ImportantExtinctionOf(const Grid& grid, const ViewedFields& viewed)
{
  const float* base = viewed.base ? viewed.base : viewed.extinction;
  const auto piece = OrWhole(viewed.piece, grid);
  const std::vector<NodeBox> slabs = EvenSlabs(*piece->ranks, grid.nodes);
  const auto rank = std::size_t(piece->ranks->Rank());
  const NodeBox own = slabs[rank];
  const std::vector<NodeBox> wanted = WithGhosts(slabs, 1, grid.nodes);
  const FieldInBox bases = FieldIn(*piece, wanted, base);
  const FieldInBox importances = FieldIn(*piece, wanted, viewed.importance);
  std::vector<double> rows(std::size_t(grid.nodes.y) * std::size_t(grid.nodes.z), 0.0);
  if (!own.Empty())
  {
    FillRowsOfImportantExtinction(
      grid, wanted[rank].along[2], own.along[2], bases.Data(), importances.Data(), rows.data());
  }
  piece->ranks->Gather(rows.data(), rows.size());
  return SumOfRows(grid, rows);
}
}

ViewScore::ViewScore(
  const Grid& grid, const ViewedFields& viewed, double rayDensity, BackendKind backend)
  : All(OrWhole(viewed.piece, grid)->ranks)
  , Fields(std::make_unique<ViewFields>(grid, viewed))
  , RayDensity(DensityOf(this->Fields->Nodes(), rayDensity))
  , Important(ImportantExtinctionOf(grid, viewed))
{
  // Memory for two copies of the fields; the rays of a direction need little.
  const Index nodes = this->Fields->InOrder().grid.NodeCount();
  const std::size_t fields = (viewed.base ? 3 : 2) + (viewed.least ? 1 : 0);
  const BackendChoice choice =
    ChooseBackend(backend, { nodes, 2 * fields * sizeof(float) * static_cast<std::size_t>(nodes) });
  this->Name = NameOnRanks(choice.name, *this->All);
  this->Sweep = BackendOf(choice.cuda).MakeScoreSweep(*this->Fields);
}

Score ViewScore::At(const Camera& camera) const
{
  return ScoreOf(
    this->Sweep->See(this->Fields->PartsOf(camera, this->RayDensity)), this->Important);
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
