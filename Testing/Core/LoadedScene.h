// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A real scene for the solver, and the fixture of the tests on them.

#ifndef limpid_testing_LoadedScene_h
#define limpid_testing_LoadedScene_h

#include "SceneForSolver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

namespace limpid
{
struct Bars
{
  const char* name;
  double base;       ///< S before, by an earlier independent march; 0: unknown [length^2]
  double leastAfter; ///< S after, at least [length^2]
};

inline std::ostream& operator<<(std::ostream& stream, const Bars& bars)
{
  return stream << bars.name;
}

inline std::string PathOf(const std::string& name)
{
  return std::string(LIMPID_TEST_DATA) + "/" + name + ".scene.json";
}

inline bool IsThere(const std::string& name)
{
  return std::ifstream(PathOf(name)).good();
}

/// A scene as the tests of the solver take it.
struct LoadedScene : SceneOfFile
{
  Settings settings;

  explicit LoadedScene(const std::string& sceneName)
    : SceneOfFile(PathOf(sceneName))
  {
  }

  Solver MakeSolver() const { return SceneOfFile::MakeSolver(this->settings); }

  /// What people have: opacity from 0 to 1 over the range of the scalars, ParaView's default, or 1
  /// for the topmost 3 % of them and 0 for others, over a distance of `cells` cells; important is
  /// what is above the 97th percentile.
  void Classify(bool ramp, double cells)
  {
    const std::vector<double>& scalars = this->file.scalars;
    const auto [low, high] = std::minmax_element(scalars.begin(), scalars.end());
    const double top = this->Top();
    const double distance = cells * std::cbrt(this->grid.CellVolume());
    for (std::size_t node = 0; node < scalars.size(); ++node)
    {
      const double opacity =
        ramp ? (scalars[node] - *low) / (*high - *low) : double(scalars[node] > top);
      this->extinction[node] =
        static_cast<float>(-std::log(std::max(1 - opacity, 1e-6)) / distance);
      this->importance[node] =
        static_cast<float>(std::clamp((scalars[node] / top - 0.95) / 0.05, 0.0, 1.0));
    }
  }

  /// The 97th percentile of the scalars [data].
  double Top() const
  {
    std::vector<double> ordered = this->file.scalars;
    const auto top = ordered.begin() + static_cast<std::ptrdiff_t>(0.97 * double(ordered.size()));
    std::nth_element(ordered.begin(), top, ordered.end());
    return *top;
  }
};

class RealScene : public ::testing::TestWithParam<Bars>
{
protected:
  void SetUp() override
  {
    if (!IsThere(GetParam().name))
    {
      GTEST_SKIP() << PathOf(GetParam().name)
                   << " is not there. Set LIMPID_TEST_DATA to the folder with the test scenes.";
    }
  }
};
}

#endif
