// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The derivative of the score on real scenes, against central differences of the march.

#include "LoadedScene.h"
#include "NodeImportanceOfAll.h"
#include "Tolerance.h"

#include "energy/VisibilityTerm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
/// Three long waves of random phase, zero on the border of the image, where a node stands for less
/// than a cell.
std::vector<double> SmoothDirection(const Grid& grid, unsigned seed)
{
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  double frequency[3][3];
  double phase[3];
  for (int wave = 0; wave < 3; ++wave)
  {
    for (double& value : frequency[wave])
    {
      value = pi * (2 * uniform(generator) - 1);
    }
    phase[wave] = pi * uniform(generator);
  }
  std::vector<double> direction;
  direction.reserve(static_cast<std::size_t>(grid.NodeCount()));
  for (int k = 0; k < grid.nodes.z; ++k)
  {
    for (int j = 0; j < grid.nodes.y; ++j)
    {
      for (int i = 0; i < grid.nodes.x; ++i)
      {
        const Vec3 x = Vec3(i, j, k) / (Vec3(grid.nodes) - 1.0);
        double value = 1;
        for (int wave = 0; wave < 3; ++wave)
        {
          value += std::sin(phase[wave] + frequency[wave][0] * x.x + frequency[wave][1] * x.y +
            frequency[wave][2] * x.z);
        }
        direction.push_back(value * std::sin(pi * x.x) * std::sin(pi * x.y) * std::sin(pi * x.z));
      }
    }
  }
  return direction;
}

class RealDerivative : public RealScene
{
};
}

// dS along smooth directions: sum over voxels of the core's gradient against central differences of
// the march.
TEST_P(RealDerivative, IsThatOfTheMarch)
{
  const LoadedScene scene(GetParam().name);
  const truth::SceneFile& file = scene.file;
  const Occupancy everything(scene.grid, file.extinction.data(), file.importance.data(), false);
  VisibilityTerm<HostDevice> term(HostDevice::Shared(), scene.grid, everything,
    SourceOfCamera(scene.camera, scene.grid, false), 1.0);
  std::vector<float> gradient(file.extinction.size(), 0.0f);
  const std::vector<float> nodeImportance = NodeImportanceOfAll(scene.grid, file.importance.data());
  Seen seen;
  term.Differentiate({ file.extinction.data(), file.importance.data(), nodeImportance.data() },
    Derivative::Volume, { 1.0f, 1.0f }, gradient.data(), &seen);
  const std::vector<double> importance(file.importance.begin(), file.importance.end());
  truth::Sampling sampling;
  sampling.raysPerVoxel = 2;

  for (unsigned seed = 1; seed <= 4; ++seed)
  {
    SCOPED_TRACE("direction " + std::to_string(seed));
    const std::vector<double> direction = SmoothDirection(scene.grid, seed);
    const double step = 1e-4 * file.majorant;
    const auto score = [&](double e)
    {
      std::vector<double> extinction(file.extinction.begin(), file.extinction.end());
      for (std::size_t node = 0; node < extinction.size(); ++node)
      {
        extinction[node] += e * direction[node];
      }
      return truth::VisibilityScore(
        truth::Volume<double>{ file.lattice, extinction.data(), importance.data() }, file.Eye(),
        sampling);
    };

    const double difference = (score(step) - score(-step)) / (2 * step);
    double derivative = 0;
    double summands = 0;
    for (std::size_t node = 0; node < gradient.size(); ++node)
    {
      const double summand = -gradient[node] * direction[node] * scene.grid.CellVolume();
      derivative += summand;
      summands += std::abs(summand);
    }

    std::cout << GetParam().name << ": derivative " << derivative << ", march " << difference
              << " (" << 100 * (derivative / difference - 1) << " %)\n";
    // A node speaks for its cells although T bends within them: marched to every node of
    // isabel_wind, the exact gradient itself misses the difference by 0.4 % of the summands, which
    // shows where they cancel.
    EXPECT_WITHIN(derivative, difference,
      Relative(0.01, difference, "the bar for derivatives") +
        Relative(0.005, summands, "sum over nodes of summands of either sign"));
  }
}

INSTANTIATE_TEST_SUITE_P(Quick, RealDerivative, ::testing::Values(Bars{ "carotid_mra", 0, 0 }),
  ::testing::PrintToStringParamName());

INSTANTIATE_TEST_SUITE_P(Long, RealDerivative,
  ::testing::Values(Bars{ "isabel_wind", 0, 0 }, Bars{ "visible_male", 0, 0 }),
  ::testing::PrintToStringParamName());
