// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/CarriedChange.h"

#include "backend/Backend.h"
#include "math/Angle.h"
#include "math/Number.h"
#include "math/Require.h"
#include "optimize/Levels.h"
#include "optimize/Solver.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
constexpr Index valuesPerTask = 65536;

Vec3 DirectionTo(const Camera& camera, const Vec3& centre)
{
  return camera.position - (camera.parallel ? camera.focalPoint : centre);
}

Vec3 DirectionTo(const Light& light, const Vec3& centre)
{
  return light.position - (light.type == LightType::Directional ? light.focalPoint : centre);
}

/// Angle between two directions [degrees]; 0 if one has no length.
double DegreesBetween(const Vec3& one, const Vec3& other)
{
  const double degrees = AngleBetween(one, other) * (180 / pi);
  return std::isfinite(degrees) ? degrees : 0.0;
}

/// Returns c at the nodes of a scene, resampled if necessary.
std::vector<float> OnScene(
  const SceneFields& scene, const CarriedChange& change, const std::vector<float>& values)
{
  if (!scene.piece)
  {
    return change.grid.nodes == scene.grid.nodes
      ? values
      : Resampled(change.grid, values.data(), scene.grid);
  }
  const ScenePiece& before = *change.piece;
  return ResampledBox(*scene.piece->ranks, change.grid,
    FieldView::Part(const_cast<float*>(values.data()), before.nodes), before.owned, scene.grid,
    scene.piece->boxes);
}

std::vector<float> Applied(const SceneFields& scene, float majorant, const CarriedChange& change,
  const std::vector<float>& ofBase)
{
  const Communicator* ranks = scene.piece ? scene.piece->ranks.get() : nullptr;
  if (!AnyRank(ranks, !ofBase.empty()))
  {
    return {};
  }
  RequireOnAllRanks(ranks,
    [&]
    {
      LIMPID_REQUIRE(Index(ofBase.size()) == change.ValueCount(),
        "The previous change has "
          << ofBase.size() << " values for " << change.ValueCount()
          << " nodes (it belongs to another grid). Give one value per node.");
    });
  std::vector<float> values = OnScene(scene, change, ofBase);
  ParallelFor(static_cast<Index>(values.size()), valuesPerTask,
    [&](Index node)
    {
      float& value = values[std::size_t(node)];
      const float base = scene.baseExtinction[node];
      const bool empty = !(base > 0) && !(scene.importance[node] > 0);
      const float room = value < 0 ? base : std::max(majorant - base, 0.0f);
      value = empty ? 0.0f : base + std::clamp(value, -1.0f, 1.0f) * room;
    });
  return values;
}
}

double CarriedChange::NearnessTo(
  const Camera& otherCamera, const Light& otherLight, const Settings& otherSettings) const
{
  Settings same = otherSettings;
  same.otherCameras = this->settings.otherCameras;
  same.backend = this->settings.backend; // any backend gives an equivalent result
  const std::vector<Camera>& one = this->settings.otherCameras;
  const std::vector<Camera>& other = otherSettings.otherCameras;
  if (!(same == this->settings) || one.size() != other.size())
  {
    return 0;
  }
  const Vec3 centre = this->grid.Centre();
  const auto degreesBetween = [&centre](const auto& before, const auto& now)
  { return DegreesBetween(DirectionTo(before, centre), DirectionTo(now, centre)); };
  double degrees =
    std::max(degreesBetween(this->camera, otherCamera), degreesBetween(this->light, otherLight));
  for (std::size_t i = 0; i < one.size(); ++i)
  {
    degrees = std::max(degrees, degreesBetween(one[i], other[i]));
  }
  constexpr double farAway = 20;
  return this->likeness * std::max(1 - degrees / farAway, 0.0);
}

CarriedChange OnPiece(
  CarriedChange change, const Grid& grid, const std::shared_ptr<const ScenePiece>& piece)
{
  for (std::vector<float>* values : { &change.ofExtinction, &change.ofLight })
  {
    if (!values->empty())
    {
      *values = ResampledBox(change.grid, values->data(), grid, piece->nodes);
    }
  }
  change.grid = grid;
  change.piece = piece;
  return change;
}

CarriedChange ForAllRanks(CarriedChange change, const Grid& grid)
{
  const ScenePiece& piece = *change.piece;
  for (std::vector<float>* values : { &change.ofExtinction, &change.ofLight })
  {
    if (piece.ranks->AnyOf(!values->empty()))
    {
      *values = GatheredResampling(
        *piece.ranks, change.grid, FieldView::Part(values->data(), piece.nodes), piece.owned, grid);
    }
  }
  change.grid = grid;
  change.piece = nullptr;
  return change;
}

std::vector<float> ChangeOf(Index count, const float* base, const float* extinction, float majorant)
{
  std::vector<float> change(static_cast<std::size_t>(count));
  ParallelFor(count, valuesPerTask,
    [&](Index node)
    {
      const float difference = extinction[node] - base[node];
      const float room = difference < 0 ? base[node] : majorant - base[node];
      change[std::size_t(node)] = room > 0 ? std::clamp(difference / room, -1.0f, 1.0f) : 0.0f;
    });
  return change;
}

CarriedExtinction AppliedTo(const SceneFields& scene, float majorant, const CarriedChange& change)
{
  const bool sharedAlike = bool(scene.piece) == bool(change.piece);
  if (change.Empty() || !sharedAlike || !scene.grid.HasSameBox(change.grid))
  {
    return {};
  }
  return { Applied(scene, majorant, change, change.ofExtinction),
    Applied(scene, majorant, change, change.ofLight) };
}
}
