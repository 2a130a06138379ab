// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_benchmarks_TimedScene_h
#define limpid_testing_benchmarks_TimedScene_h

#include "GpuScene.h"

#include <string>

namespace limpid::benchmark
{
/// A scene, whoever owns it.
struct TimedScene
{
  std::string name;
  SceneFields fields;
  Camera camera;
  Light light;
  bool skip = true; ///< Settings::skipUnneeded
};

inline TimedScene SceneOf(const GpuScene& scene)
{
  return { scene.name, scene.Fields(), scene.camera, scene.light, true };
}
}

#endif
