// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/PreparedScene.h"

#include "backend/Backend.h"
#include "energy/NodeImportance.h"
#include "math/Require.h"

#include <algorithm>

namespace limpid
{
namespace
{
void RequireFields(const SceneFields& scene)
{
  scene.grid.Require();
  LIMPID_REQUIRE(scene.baseExtinction != nullptr,
    "There is no base extinction (the optimisation starts from it). Give an array.");
  LIMPID_REQUIRE(scene.importance != nullptr,
    "There is no importance (nothing tells what is to be seen). Give an array.");
}

/// Checks all values of a field and returns the largest.
template <class Valid>
float LargestValue(
  Index count, const float* field, const char* name, const char* range, const Valid& valid)
{
  constexpr Index blockSize = 65536;
  const Index blocks = (count + blockSize - 1) / blockSize;
  std::vector<float> largest(static_cast<std::size_t>(blocks), 0.0f);
  std::vector<Index> bad(static_cast<std::size_t>(blocks), -1);
  ParallelFor(blocks,
    [&](Index block)
    {
      const Index end = std::min(count, (block + 1) * blockSize);
      float most = 0;
      bool allValid = true;
      for (Index voxel = block * blockSize; voxel < end; ++voxel)
      {
        allValid &= valid(field[voxel]);
        most = field[voxel] > most ? field[voxel] : most;
      }
      largest[std::size_t(block)] = most;
      for (Index voxel = block * blockSize; voxel < end && !allValid; ++voxel)
      {
        allValid = !valid(field[voxel]);
        bad[std::size_t(block)] = voxel;
      }
    });
  for (const Index voxel : bad)
  {
    LIMPID_REQUIRE(voxel < 0,
      "The " << name << " of voxel " << voxel << " is " << field[voxel]
             << " (the energy of Eq. 21 is not defined there). Keep it " << range << '.');
  }
  return *std::max_element(largest.begin(), largest.end());
}

void RequireEye(const char* what, const Eye& eye, const Grid& grid)
{
  const double distance = glm::length(eye.origin - 0.5 * Vec3(grid.nodes - 1));
  LIMPID_REQUIRE(eye.parallel || distance < 1e12 * glm::length(Vec3(grid.nodes)),
    "The " << what << " is " << distance / glm::length(Vec3(grid.nodes))
           << " image diagonals away (its rays cannot be told apart). Move it closer or use a "
              "parallel projection.");
}
}

void RequireSettings(const Settings& settings)
{
  settings.Require();
  ChooseBackend(settings.backend, 0);
}

void RequireReach(const Problem& problem)
{
  RequireEye("camera", problem.camera, problem.grid);
  RequireEye("light", problem.light, problem.grid);
}

void RequireView(
  const Camera& camera, const Light& light, const Settings& settings, const Grid& grid)
{
  RequireEye("camera", EyeOfCamera(camera, grid, settings.restrictToView), grid);
  RequireEye("light", EyeOfLight(light, grid), grid);
}

PreparedScene::PreparedScene(const SceneFields& scene)
  : Fields(scene)
{
  RequireFields(scene);
  const Index count = scene.grid.NodeCount();
  this->LargestExtinction = LargestValue(count, scene.baseExtinction, "base extinction",
    "finite and not negative", [](float value) { return (value >= 0) & (value < 3e38f); });
  this->SomethingImportant = LargestValue(count, scene.importance, "importance", "between 0 and 1",
                               [](float value) { return (value >= 0) & (value <= 1); }) > 0;
}

bool PreparedScene::SomethingToSee() const
{
  return this->SomethingImportant && this->LargestExtinction > 0 && this->Fields.grid.HasVolume();
}

Problem PreparedScene::ProblemFor(
  const Camera& camera, const Light& light, const Settings& settings)
{
  const SceneFields& scene = this->Fields;
  if (this->Important.empty())
  {
    this->Important = NodeImportanceOfFilled(scene.grid, scene.baseExtinction, scene.importance);
  }
  if (!this->Filled || this->Filled->Skips() != settings.skipUnneeded)
  {
    this->Filled = std::make_shared<const Occupancy>(
      scene.grid, scene.baseExtinction, this->Important.data(), settings.skipUnneeded);
  }
  Problem task;
  task.grid = scene.grid;
  task.baseExtinction = scene.baseExtinction;
  task.importance = scene.importance;
  task.nodeImportance = this->Important.data();
  task.occupancy = this->Filled;
  task.resident = this->Kept;
  task.majorant = this->LargestExtinction;
  task.camera = EyeOfCamera(camera, scene.grid, settings.restrictToView);
  task.light = EyeOfLight(light, scene.grid);
  task.settings = settings;
  return task;
}
}
