// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What is written for devices on real scenes, against the processor's own sweeps.

#include "LoadedScene.h"
#include "TestedDevice.h"
#include "Tolerance.h"

#include "optimize/PreparedScene.h"
#include "optimize/SolverBackend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <vector>

using namespace limpid;

namespace
{
double LargestDifference(const std::vector<float>& a, const std::vector<float>& b)
{
  double largest = 0;
  for (std::size_t voxel = 0; voxel < a.size(); ++voxel)
  {
    largest = std::max(largest, std::abs(double(a[voxel]) - double(b[voxel])));
  }
  return largest;
}

/// Root mean square of the difference over that of the second field.
double RelativeDifference(const std::vector<float>& a, const std::vector<float>& b)
{
  double difference = 0;
  double size = 0;
  for (std::size_t voxel = 0; voxel < a.size(); ++voxel)
  {
    difference += std::pow(double(a[voxel]) - double(b[voxel]), 2);
    size += std::pow(double(b[voxel]), 2);
  }
  return std::sqrt(difference / size);
}

struct Outputs
{
  IterationRecord record;
  std::vector<float> extinction;
  std::vector<float> transmittance;
  std::vector<float> lightTransmittance;
};

/// What there is after `iterations`.
Outputs Optimize(SolverBackend& backend, const Problem& problem, int iterations)
{
  const float* base = problem.baseExtinction;
  const Index count = problem.grid.NodeCount();
  const auto run = backend.MakeMinimizer(problem, std::vector<float>(base, base + count), false);
  Outputs outputs;
  outputs.record = run->Start();
  for (int i = 0; i < iterations && !run->Converged(); ++i)
  {
    outputs.record = run->Iterate();
  }
  outputs.extinction = run->TakeBest();
  outputs.transmittance.resize(outputs.extinction.size());
  outputs.lightTransmittance.resize(outputs.extinction.size());
  backend.FindTransmittance(
    problem, problem.Camera(), 2, outputs.extinction.data(), outputs.transmittance.data());
  backend.FindTransmittance(
    problem, problem.Light(), 2, outputs.extinction.data(), outputs.lightTransmittance.data());
  return outputs;
}
}

class SceneOnDevice : public RealScene
{
};

TEST_P(SceneOnDevice, HasTheOutputsOfTheProcessor)
{
  const LoadedScene scene(GetParam().name);
  PreparedScene prepared(
    { scene.grid, scene.file.extinction.data(), scene.file.importance.data() });
  const Problem problem = prepared.ProblemFor(scene.camera, scene.light, scene.settings);
  const std::shared_ptr<SolverBackend> device = MakeSolverBackend(MakeTestedDevice());

  const Outputs expected = Optimize(*MakeSolverBackend(HostDevice::Shared()), problem, 1);
  const Outputs found = Optimize(*device, problem, 1);

  const double extinction = RelativeDifference(found.extinction, expected.extinction);
  const double largest =
    LargestDifference(found.extinction, expected.extinction) / prepared.Majorant();
  const double transmittance =
    std::max(LargestDifference(found.transmittance, expected.transmittance),
      LargestDifference(found.lightTransmittance, expected.lightTransmittance));
  const double score =
    std::abs(found.record.score.visibility / expected.record.score.visibility - 1);
  std::cout << GetParam().name << " after one iteration: extinction " << extinction
            << " (root mean square), at most " << largest << " of the majorant, transmittances "
            << transmittance << ", score " << score << '\n';
  // Roundings along a ray have either sign, so that they grow as the root of their number. On each
  // slice, two carry the importance behind (visible + passed * behind, none above 1); the policy
  // multiplies that by its gain. Some 32 find the optical depth of a layer from eight nodes in each
  // half; in the end, 50 or so blend sixteen rays by weights that add up to 1.6 without their
  // signs.
  const Int3& nodes = scene.grid.nodes;
  const double root = std::sqrt(double(std::max({ nodes.x, nodes.y, nodes.z })));
  const double gain = scene.settings.weights.view / problem.RegularizationWeight();
  const Tolerance ofVoxels = Roundoff<float>(2 * root, gain / prepared.Majorant());
  EXPECT_LE(extinction, 1e-4) << "the bar for all outputs";
  EXPECT_WITHIN(largest, 0, ofVoxels);
  EXPECT_WITHIN(transmittance, 0, Roundoff<float>(32 * root + 1.6 * 50, 1));
  EXPECT_WITHIN(score, 0, Roundoff<float>(2 * root, 1));

  const int all = scene.settings.maximumIterations;
  const double optimized =
    Optimize(*MakeSolverBackend(HostDevice::Shared()), problem, all).record.score.visibility;
  const double onDevice = Optimize(*device, problem, all).record.score.visibility;
  std::cout << GetParam().name << " optimised: score off by " << std::abs(onDevice / optimized - 1)
            << '\n';
  EXPECT_LE(std::abs(onDevice / optimized - 1), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Quick, SceneOnDevice,
  ::testing::Values(Bars{ "carotid_mra", 0, 0 }, Bars{ "isabel_wind", 0, 0 }),
  ::testing::PrintToStringParamName());

INSTANTIATE_TEST_SUITE_P(Long, SceneOnDevice,
  ::testing::Values(
    Bars{ "visible_male", 0, 0 }, Bars{ "engine", 0, 0 }, Bars{ "vortex_rings", 0, 0 }),
  ::testing::PrintToStringParamName());
