// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Settings.h"

#include "math/Require.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

namespace limpid
{
namespace
{
void RequireNotNegative(const char* name, const char* why, double value)
{
  LIMPID_REQUIRE(std::isfinite(value) && value >= 0,
    "The " << name << " is " << value << " (" << why << "). Set it to zero or more.");
}
}

void Settings::Require() const
{
  this->ament.Require();
  for (const WeightInfo& info : allWeights)
  {
    RequireNotNegative(info.name, info.whyNotNegative, this->weights.*info.weight);
  }
  RequireNotNegative(
    "clearing threshold", "the energy of Eq. (21) would have no minimum", this->clearingThreshold);
  RequireNotNegative("tolerance", "changes cannot be negative", this->tolerance);
  RequireNotNegative("time limit", "durations cannot be negative", this->maximumSeconds);
  LIMPID_REQUIRE(this->protectImportance >= 0 && this->protectImportance <= 1,
    "The protection of important structures is "
      << this->protectImportance
      << " (it is the fraction of their extinction that is kept). Set it between 0 and 1.");
  LIMPID_REQUIRE(this->emphasis >= 0 && this->emphasis <= 1,
    "The emphasis is " << this->emphasis
                       << " (0 limits the extinction to that of the data, 1 to the largest "
                          "extinction). Set it between 0 and 1.");
  LIMPID_REQUIRE(this->smoothness >= 0 && this->smoothness <= 10,
    "The smoothness is "
      << this->smoothness
      << " (at 10, neighbours already outweigh any gain). Set it between 0 and 10.");
  RequireNotNegative("temporal coherence", "the result would be driven away from the previous one",
    this->temporalCoherence);
  LIMPID_REQUIRE(this->otherCameras.empty() || InfoOf(this->method).iterates,
    "Several cameras were given to "
      << InfoOf(this->method).name
      << " (this method supports one camera only). Use the method Optimized or one camera.");
  LIMPID_REQUIRE(
    std::isfinite(this->rayDensity) && this->rayDensity >= 0.1 && this->rayDensity <= 16,
    "The ray density is " << this->rayDensity
                          << " rays per voxel (fewer would miss structures, more would only take "
                             "longer). Set it between 0.1 and 16.");
  LIMPID_REQUIRE(
    std::isfinite(this->learningRate) && this->learningRate > 0 && this->learningRate <= 1,
    "The learning rate is " << this->learningRate
                            << " of the largest extinction (steps would leave the valid range or "
                               "change nothing). Set it above 0 and at most 1.");
  LIMPID_REQUIRE(this->maximumIterations >= 0,
    "The number of iterations is " << this->maximumIterations
                                   << " (it cannot be negative). Set it to zero or more.");
  for (const int iterations : this->iterationsPerLevel)
  {
    LIMPID_REQUIRE(iterations >= 0,
      "The number of iterations of a level is "
        << iterations << " (it cannot be negative). Set it to zero or more.");
  }
}

bool SeesWhatScoresAreOf(const Settings& settings)
{
  return InfoOf(settings.method).iterates && settings.weights.view > 0 &&
    settings.importanceSmoothing == ImportanceSmoothing::Off;
}

Settings ForCameras(Settings settings, const std::vector<Camera>& cameras)
{
  settings.otherCameras.assign(cameras.begin() + 1, cameras.end());
  return settings;
}

bool operator==(const Settings& one, const Settings& other)
{
  const auto values = [](const Settings& s)
  {
    return std::tie(s.method, s.ament, s.mode, s.solver, s.maximumIterations, s.iterationsPerLevel,
      s.learningRate, s.tolerance, s.maximumSeconds, s.derivative, s.rayDensity, s.skipUnneeded,
      s.restrictToView, s.protectImportance, s.emphasis, s.clearingThreshold, s.importanceSmoothing,
      s.smoothness, s.temporalCoherence, s.scoreIterations, s.otherCameras, s.backend);
  };
  const auto sameWeight = [&](const WeightInfo& info)
  { return one.weights.*info.weight == other.weights.*info.weight; };
  return values(one) == values(other) &&
    std::all_of(std::begin(allWeights), std::end(allWeights), sameWeight);
}

std::string NotOnRanks(const Settings& settings)
{
  if (settings.method != Method::Optimized)
  {
    return std::string("the method ") + InfoOf(settings.method).name;
  }
  return {};
}

Settings ForRanks(Settings settings)
{
  const std::string left = NotOnRanks(settings);
  LIMPID_REQUIRE(left.empty(),
    "Ranks share the scene, and " << left
                                  << " is set (this is not supported in distributed runs). Turn it "
                                     "off, or give one rank the whole scene.");
  LIMPID_REQUIRE(settings.backend != BackendKind::Cuda,
    "Ranks share the scene, and the backend is CUDA (distributed runs are supported on CPUs only). "
    "Use the backend Auto or CPU.");
  settings.backend = BackendKind::Cpu;
  return settings;
}
}
