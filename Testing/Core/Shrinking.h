// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A failing scene is made simpler as long as it fails: what is left says what is wrong.

#ifndef limpid_testing_Shrinking_h
#define limpid_testing_Shrinking_h

#include "RandomScene.h"

#include <gtest/gtest.h>

#include <functional>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

namespace limpid
{
/// What is wrong with a scene; nothing if all is well.
using Property = std::function<std::string(const BoxScene&)>;

/// The nodes from `begin` on; eyes stay where they are.
inline BoxScene Cropped(const BoxScene& scene, const Int3& begin, const Int3& nodes)
{
  BoxScene part(nodes, scene.grid.PointToWorld(Vec3(begin)), scene.grid.spacing);
  part.grid.direction = scene.grid.direction;
  part.camera = scene.camera;
  part.light = scene.light;
  part.settings = scene.settings;
  part.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      const Int3 from = begin + Int3(i, j, k);
      const Index source =
        (Index(from.z) * scene.grid.nodes.y + from.y) * scene.grid.nodes.x + from.x;
      part.extinction[node] = scene.extinction[std::size_t(source)];
      part.importance[node] = scene.importance[std::size_t(source)];
    });
  return part;
}

/// All scenes that are simpler by one step.
inline std::vector<BoxScene> SimplerThan(const BoxScene& scene)
{
  std::vector<BoxScene> simpler;
  const auto add = [&](const std::function<void(BoxScene&)>& change)
  {
    simpler.push_back(scene);
    change(simpler.back());
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    const int count = scene.grid.nodes[axis];
    for (const int fewer : { count / 2, count - 1 })
    {
      if (fewer >= 1 && fewer < count)
      {
        Int3 nodes = scene.grid.nodes;
        nodes[axis] = fewer;
        Int3 last(0);
        last[axis] = count - fewer;
        simpler.push_back(Cropped(scene, Int3(0), nodes));
        simpler.push_back(Cropped(scene, last, nodes));
      }
    }
  }
  Settings plain;
  plain.weights.light = 0;
  if (!(scene.settings == plain))
  {
    add([&](BoxScene& other) { other.settings = plain; });
  }
  for (const auto field : { &BoxScene::importance, &BoxScene::extinction })
  {
    const std::vector<float>& values = scene.*field;
    for (std::size_t node = 0; node < values.size(); ++node)
    {
      if (values[node] != 0)
      {
        add([&](BoxScene& other) { (other.*field)[node] = 0; });
      }
    }
  }
  return simpler;
}

/// The simplest scene on the way from `scene` down that still fails.
inline BoxScene Shrunk(BoxScene scene, const Property& property)
{
  constexpr int mostTrials = 3000;
  int trials = 0;
  for (bool goesOn = true; goesOn;)
  {
    goesOn = false;
    for (BoxScene& simpler : SimplerThan(scene))
    {
      if (++trials > mostTrials)
      {
        return scene;
      }
      if (!property(simpler).empty())
      {
        scene = std::move(simpler);
        goesOn = true;
        break;
      }
    }
  }
  return scene;
}

/// Everything that makes the scene again.
inline std::string DescriptionOf(const BoxScene& scene)
{
  std::ostringstream text;
  text << std::setprecision(17);
  const auto put = [&](const char* name, const Vec3& v)
  { text << "  " << name << " " << v.x << ", " << v.y << ", " << v.z << "\n"; };
  put("nodes", Vec3(scene.grid.nodes));
  put("origin", scene.grid.origin);
  put("spacing", scene.grid.spacing);
  for (int axis = 0; axis < 3; ++axis)
  {
    put("direction", scene.grid.direction[axis]);
  }
  put(scene.camera.parallel ? "parallel camera" : "camera", scene.camera.position);
  put("looks at", scene.camera.focalPoint);
  put(scene.light.type == LightType::Directional ? "directional light" : "light",
    scene.light.position);
  put("shines at", scene.light.focalPoint);
  const Settings& settings = scene.settings;
  text << "  weights " << settings.weights.regularization << ", " << settings.weights.view << ", "
       << settings.weights.light << ", solver " << int(settings.solver) << ", mode "
       << int(settings.mode) << ", ray density " << settings.rayDensity << ", protection "
       << settings.protectImportance << ", emphasis " << settings.emphasis
       << ", clearing threshold " << settings.clearingThreshold << ", smoothing of importance "
       << int(settings.importanceSmoothing) << ", smoothness " << settings.smoothness
       << ", coherence " << settings.temporalCoherence << "\n";
  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      if (scene.extinction[node] != 0 || scene.importance[node] != 0)
      {
        text << "  node " << i << " " << j << " " << k << ": extinction " << scene.extinction[node]
             << ", importance " << scene.importance[node] << "\n";
      }
    });
  return text.str();
}

/// Checks scenes made from the seeds [first, first + count), usually one of ten; stops at the first
/// that fails.
template <class MakeScene>
void CheckAtRandom(
  unsigned first, unsigned count, const MakeScene& makeScene, const Property& property)
{
  for (unsigned seed = first; seed < first + count; seed += unsigned(OneOf(10)))
  {
    const BoxScene scene = makeScene(seed);
    if (!property(scene).empty())
    {
      const BoxScene simplest = Shrunk(scene, property);
      ADD_FAILURE() << "scene " << seed << ": " << property(scene)
                    << "\nSimpler: " << property(simplest) << "\n"
                    << DescriptionOf(simplest);
      return;
    }
  }
}
}

#endif
