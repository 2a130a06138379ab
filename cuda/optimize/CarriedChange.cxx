// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/CarriedChange.h"

#include "backend/Backend.h"
#include "distributed/FieldResampling.h"
#include "math/Angle.h"
#include "math/Number.h"
#include "math/Require.h"
#include "optimize/SceneFields.h"

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

/// `from`, `to`: the decompositions of the change and of the scene.
std::vector<float> Applied(const SceneFields& scene, const ScenePiece& to, float majorant,
  const CarriedChange& change, const ScenePiece& from, const std::vector<float>& ofBase)
{
  RequireOnAllRanks(*to.ranks,
    [&]
    {
      LIMPID_REQUIRE(Index(ofBase.size()) == change.ValueCount(),
        "The previous change has "
          << ofBase.size() << " values for " << change.ValueCount()
          << " nodes (it belongs to another grid). Give one value per node.");
    });
  std::vector<float> values = ResampledIn(from, change.grid, ofBase.data(), scene.grid, to.boxes);
  const ChangedNode changed{ majorant };
  ParallelFor(static_cast<Index>(values.size()), valuesPerTask,
    [&](Index node)
    {
      float& value = values[std::size_t(node)];
      value = changed(value, scene.baseExtinction[node], scene.importance[node]);
    });
  return values;
}
}

float ChangedNode::operator()(float change, float base, float importance) const
{
  const bool empty = !(base > 0) && !(importance > 0);
  const float room = change < 0 ? base : std::max(this->majorant - base, 0.0f);
  return empty ? 0.0f : base + std::clamp(change, -1.0f, 1.0f) * room;
}

Index CarriedChange::ValueCount() const
{
  return this->piece ? this->piece->nodes.Count() : this->grid.NodeCount();
}

double CarriedChange::NearnessTo(
  const Camera& otherCamera, const Light& otherLight, const Settings& otherSettings) const
{
  Settings same = otherSettings;
  same.otherCameras = this->settings.otherCameras;
  same.backend = this->settings.backend; // any backend gives an equivalent result
  same.memoryLimit = this->settings.memoryLimit;
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

CarriedChange DistributedAs(const SceneFields& scene, CarriedChange change)
{
  const auto from = OrWhole(change.piece, change.grid);
  const auto to = OrWhole(scene.piece, scene.grid);
  if (from->IsWhole() == to->IsWhole())
  {
    return change;
  }
  for (std::vector<float>* values : { &change.ofExtinction, &change.ofLight })
  {
    if (!values->empty())
    {
      *values = ResampledIn(*from, change.grid, values->data(), scene.grid, { to->nodes });
    }
  }
  change.grid = scene.grid;
  change.piece = to;
  return change;
}

CarriedChange Gathered(CarriedChange change, const Grid& coarser)
{
  const auto from = OrWhole(change.piece, change.grid);
  if (from->IsWhole())
  {
    return change;
  }
  for (std::vector<float>* values : { &change.ofExtinction, &change.ofLight })
  {
    if (from->ranks->AnyOf(!values->empty()))
    {
      *values = ResampledForAll(*from, change.grid, values->data(), coarser);
    }
  }
  change.grid = coarser;
  change.piece = ScenePiece::Whole(coarser);
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

FoundExtinctions CarriedExtinction::Take()
{
  FoundExtinctions taken;
  taken.extinction = std::make_shared<FoundExtinction>(std::move(this->extinction));
  if (this->hasLight)
  {
    taken.light = std::make_shared<FoundExtinction>(std::move(this->light));
  }
  return taken;
}

std::optional<CarriedExtinction> AppliedTo(
  const SceneFields& scene, float majorant, const CarriedChange& change)
{
  const auto from = OrWhole(change.piece, change.grid);
  const auto to = OrWhole(scene.piece, scene.grid);
  // A subdomain may be empty.
  const auto has = [&to](const std::vector<float>& values)
  { return to->ranks->AnyOf(!values.empty()); };
  const bool sharedAlike = from->IsWhole() == to->IsWhole();
  if (!sharedAlike || !scene.grid.HasSameBox(change.grid) || !has(change.ofExtinction))
  {
    return {};
  }
  const auto applied = [&](const std::vector<float>& ofBase)
  { return Applied(scene, *to, majorant, change, *from, ofBase); };
  CarriedExtinction carried{ applied(change.ofExtinction), {}, has(change.ofLight) };
  if (carried.hasLight)
  {
    carried.light = applied(change.ofLight);
  }
  return carried;
}
}
