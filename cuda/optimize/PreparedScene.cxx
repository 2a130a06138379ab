// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/PreparedScene.h"

#include "energy/Despeckle.h"
#include "energy/SceneSurvey.h"
#include "math/Require.h"

#include <algorithm>
#include <utility>

namespace limpid
{
namespace
{
constexpr float LargestValue = 3e38f; // of an extinction

void RequireFields(const SceneFields& scene)
{
  scene.grid.Require();
  LIMPID_REQUIRE(scene.baseExtinction != nullptr,
    "There is no base extinction (the optimisation starts from it). Give an array.");
  LIMPID_REQUIRE(scene.importance != nullptr,
    "There is no importance (nothing tells what is to be seen). Give an array.");
  LIMPID_REQUIRE(scene.majorant >= 0 && scene.majorant <= LargestValue,
    "The majorant is " << scene.majorant
                       << " (Eq. (25) needs an upper bound of the extinction). Give the largest "
                          "extinction of the transfer function, or 0 for that of the scene.");
}

/// A field, what it is called, and what its values may be.
struct CheckedField
{
  const float* values;
  float most;
  const char* name;
  const char* range;
};

void RequireRange(const CheckedField& field, const FieldRange& found)
{
  Index voxel = 0;
  while (!found.valid && field.values[voxel] >= 0 && field.values[voxel] <= field.most)
  {
    ++voxel;
  }
  LIMPID_REQUIRE(found.valid,
    "The " << field.name << " of voxel " << voxel << " is " << field.values[voxel]
           << " (the energy of Eq. (21) is not defined there). Keep it " << field.range << '.');
}

void RequireDistance(const char* what, const RaySource& source, const Grid& grid)
{
  const double distance = glm::length(source.origin - 0.5 * Vec3(grid.nodes - 1));
  LIMPID_REQUIRE(source.parallel || distance < 1e12 * glm::length(Vec3(grid.nodes)),
    "The " << what << " is " << distance / glm::length(Vec3(grid.nodes))
           << " image diagonals away (its rays cannot be told apart). Move it closer or use a "
              "parallel projection.");
}
}

void RequireSettings(const Settings& settings)
{
  settings.Require();
  ChooseBackend(settings.backend, {});
}

void RequireReach(const Problem& problem)
{
  RequireDistance("camera", problem.camera, problem.grid);
  for (const RaySource& camera : problem.otherCameras)
  {
    RequireDistance("camera", camera, problem.grid);
  }
  RequireDistance("light", problem.light, problem.grid);
}

void RequireView(
  const Camera& camera, const Light& light, const Settings& settings, const Grid& grid)
{
  RequireDistance("camera", SourceOfCamera(camera, grid, settings.restrictToView), grid);
  for (const Camera& other : settings.otherCameras)
  {
    RequireDistance("camera", SourceOfCamera(other, grid, settings.restrictToView), grid);
  }
  RequireDistance("light", SourceOfLight(light, grid), grid);
}

PreparedScene::PreparedScene(const SceneFields& scene)
  : Fields(scene)
{
  RequireFields(scene);
  const CheckedField extinction{ scene.baseExtinction, LargestValue, "base extinction",
    "finite and not negative" };
  const CheckedField importance{ scene.importance, 1, "importance", "between 0 and 1" };
  SceneSurvey found =
    SurveyScene(scene.grid, extinction.values, extinction.most, importance.values, importance.most);
  RequireRange(extinction, found.extinction);
  RequireRange(importance, found.importance);
  // Where nothing absorbs, there is nothing to be optimised, whatever a function could make.
  const float largest = found.extinction.largest;
  this->LargestExtinction = largest > 0 ? std::max(largest, scene.majorant) : 0.0f;
  this->SomethingImportant = found.importance.largest > 0;
  this->Given.values = importance.values;
  this->Given.ofNodes = std::move(found.nodeImportance);
  this->Given.occupancy = std::move(found.occupancy);
}

bool PreparedScene::SomethingToSee() const
{
  return this->SomethingImportant && this->LargestExtinction > 0 && this->Fields.grid.HasVolume();
}

PreparedScene::Important& PreparedScene::ImportantFor(ImportanceSmoothing smoothing)
{
  if (smoothing == ImportanceSmoothing::Off)
  {
    return this->Given;
  }
  if (!this->Despeckled)
  {
    const SceneFields& scene = this->Fields;
    auto made = std::make_unique<Important>();
    made->values = scene.despeckled;
    if (!scene.despeckled)
    {
      made->own = NodeValues(scene.grid.NodeCount());
      Despeckle(scene.grid, scene.baseExtinction, scene.importance, made->own.Data());
      made->values = made->own.Data();
    }
    SceneSurvey found =
      SurveyScene(scene.grid, scene.baseExtinction, LargestValue, made->values, 1);
    made->ofNodes = std::move(found.nodeImportance);
    made->occupancy = std::move(found.occupancy);
    this->Despeckled = std::move(made);
  }
  return *this->Despeckled;
}

const float* PreparedScene::ImportanceFor(ImportanceSmoothing smoothing)
{
  return this->ImportantFor(smoothing).values;
}

Problem PreparedScene::ProblemFor(
  const Camera& camera, const Light& light, const Settings& settings)
{
  const SceneFields& scene = this->Fields;
  Important& important = this->ImportantFor(settings.importanceSmoothing);
  if (important.occupancy->Skips() != settings.skipUnneeded)
  {
    important.occupancy = std::make_shared<const Occupancy>(
      scene.grid, scene.baseExtinction, important.ofNodes.Data(), settings.skipUnneeded);
  }
  Problem task;
  task.grid = scene.grid;
  task.baseExtinction = scene.baseExtinction;
  task.importance = important.values;
  task.nodeImportance = important.ofNodes.Data();
  task.occupancy = important.occupancy;
  task.resident = important.resident;
  task.majorant = this->LargestExtinction;
  task.camera = SourceOfCamera(camera, scene.grid, settings.restrictToView);
  for (const Camera& other : settings.otherCameras)
  {
    task.otherCameras.push_back(SourceOfCamera(other, scene.grid, settings.restrictToView));
  }
  task.light = SourceOfLight(light, scene.grid);
  task.settings = settings;
  return task;
}

CarriedExtinction PreparedScene::StayedNear(
  const CarriedChange& before, const Camera& camera, const Light& light, Problem& problem) const
{
  problem.nearness = before.NearnessTo(camera, light, problem.settings);
  if (!(problem.settings.temporalCoherence * problem.nearness > 0))
  {
    return {};
  }
  CarriedExtinction near = AppliedTo(this->Fields, this->LargestExtinction, before);
  problem.TakeIntoBounds(near.extinction);
  problem.TakeIntoBounds(near.light);
  return near;
}
}
