// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A real scene for the solver, and the fixture of the tests on them.

#ifndef limpid_testing_LoadedScene_h
#define limpid_testing_LoadedScene_h

#include "SceneForSolver.h"

#include <gtest/gtest.h>

#include <fstream>
#include <ostream>
#include <string>

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
