// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A real scene for the solver, and the fixture of the tests on them.

#ifndef limpid_testing_LoadedScene_h
#define limpid_testing_LoadedScene_h

#include "RayMarch.h"
#include "SceneFile.h"

#include "optimize/Solver.h"

#include <gtest/gtest.h>

#include <algorithm>
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

inline Vec3 FromTruth(const truth::Vector& v)
{
  return Vec3(v[0], v[1], v[2]);
}

/// A scene as the solver takes it.
struct LoadedScene
{
  truth::SceneFile file;
  Grid grid;
  Camera camera;
  Light light;
  Settings settings;

  explicit LoadedScene(const std::string& name)
    : file(truth::ReadSceneFile(PathOf(name)))
  {
    for (int c = 0; c < 3; ++c)
    {
      grid.nodes[c] = file.lattice.nodes[c];
      for (int row = 0; row < 3; ++row)
      {
        grid.direction[c][row] = file.lattice.direction[3 * row + c];
      }
    }
    grid.origin = FromTruth(file.lattice.origin);
    grid.spacing = FromTruth(file.lattice.spacing);
    camera.position = FromTruth(file.cameraPosition);
    camera.focalPoint = FromTruth(file.cameraFocalPoint);
    camera.viewUp = FromTruth(file.cameraViewUp);
    camera.viewAngle = file.cameraViewAngle;
    light.position = FromTruth(file.lightPosition);
    light.focalPoint = camera.focalPoint;
  }

  Solver MakeSolver() const
  {
    return Solver(
      { grid, file.extinction.data(), file.importance.data() }, camera, light, settings);
  }

  /// The extinction of Field "Importance Proxy": the majorant times importance.
  std::vector<float> Proxy() const
  {
    const float majorant = *std::max_element(file.extinction.begin(), file.extinction.end());
    std::vector<float> proxy(file.importance.begin(), file.importance.end());
    std::for_each(proxy.begin(), proxy.end(), [=](float& value) { value *= majorant; });
    return proxy;
  }

  double March(const std::vector<float>& extinction) const
  {
    truth::Sampling sampling;
    sampling.raysPerVoxel = 3;
    return truth::VisibilityScore(file.FieldsWith(extinction), file.Eye(), sampling);
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
