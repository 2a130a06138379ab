// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/PreparedScene.h"

#include "backend/Backend.h"
#include "backend/Simd.h"
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

/// What the values of a field are.
struct Range
{
  float largest = 0;
  bool valid = true; ///< whether all are in [0, most]
};

LIMPID_MULTIVERSION
Range RangeOf(const float* __restrict field, Index count, float most)
{
  constexpr int lanes = 16;
  float largest[lanes] = {};
  int invalid[lanes] = {};
  for (Index first = 0; first < count; first += lanes)
  {
    const int width = static_cast<int>(count - first < lanes ? count - first : lanes);
    const float* __restrict values = field + first;
    for (int i = 0; i < width; ++i)
    {
      invalid[i] |= !(values[i] >= 0) | !(values[i] <= most);
      largest[i] = values[i] > largest[i] ? values[i] : largest[i];
    }
  }
  Range range;
  for (int i = 0; i < lanes; ++i)
  {
    range.largest = largest[i] > range.largest ? largest[i] : range.largest;
    range.valid = range.valid && !invalid[i];
  }
  return range;
}

/// A field, what it is called, and what its values may be.
struct CheckedField
{
  const float* values;
  float most;
  const char* name;
  const char* range;
};

/// Checks all values of a field and returns the largest.
float LargestValue(Index count, const CheckedField& field)
{
  constexpr Index blockSize = 65536;
  const Index blocks = (count + blockSize - 1) / blockSize;
  std::vector<Range> ranges(static_cast<std::size_t>(blocks));
  ParallelFor(blocks,
    [&](Index block)
    {
      const Index first = block * blockSize;
      ranges[std::size_t(block)] =
        RangeOf(field.values + first, std::min(blockSize, count - first), field.most);
    });
  float largest = 0;
  for (const Range& range : ranges)
  {
    Index voxel = (&range - ranges.data()) * blockSize;
    while (!range.valid && field.values[voxel] >= 0 && field.values[voxel] <= field.most)
    {
      ++voxel;
    }
    LIMPID_REQUIRE(range.valid,
      "The " << field.name << " of voxel " << voxel << " is " << field.values[voxel]
             << " (the energy of Eq. 21 is not defined there). Keep it " << field.range << '.');
    largest = std::max(largest, range.largest);
  }
  return largest;
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
  this->LargestExtinction = LargestValue(
    count, { scene.baseExtinction, 3e38f, "base extinction", "finite and not negative" });
  this->SomethingImportant =
    LargestValue(count, { scene.importance, 1, "importance", "between 0 and 1" }) > 0;
}

bool PreparedScene::SomethingToSee() const
{
  return this->SomethingImportant && this->LargestExtinction > 0 && this->Fields.grid.HasVolume();
}

Problem PreparedScene::ProblemFor(
  const Camera& camera, const Light& light, const Settings& settings)
{
  const SceneFields& scene = this->Fields;
  if (this->Important.Empty())
  {
    this->Important = NodeValues(scene.grid.NodeCount());
    FillNodeImportanceOfFilled(
      scene.grid, scene.baseExtinction, scene.importance, this->Important.Data());
  }
  if (!this->Filled || this->Filled->Skips() != settings.skipUnneeded)
  {
    this->Filled = std::make_shared<const Occupancy>(
      scene.grid, scene.baseExtinction, this->Important.Data(), settings.skipUnneeded);
  }
  Problem task;
  task.grid = scene.grid;
  task.baseExtinction = scene.baseExtinction;
  task.importance = scene.importance;
  task.nodeImportance = this->Important.Data();
  task.occupancy = this->Filled;
  task.resident = this->Kept;
  task.majorant = this->LargestExtinction;
  task.camera = EyeOfCamera(camera, scene.grid, settings.restrictToView);
  task.light = EyeOfLight(light, scene.grid);
  task.settings = settings;
  return task;
}
}
