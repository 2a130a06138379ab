// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Scene files for the renderer.

#ifndef limpid_testing_benchmarks_Drawing_h
#define limpid_testing_benchmarks_Drawing_h

#include "SceneForSolver.h"
#include "SceneFunctions.h"
#include "Viewing.h"

namespace limpid::benchmark
{
/// What a camera sees, in a square picture.
inline View ViewOf(const Camera& camera, int pixels)
{
  const double distance = glm::length(camera.position - camera.focalPoint);
  View view;
  view.width = view.height = pixels;
  view.clipToWorld = Perspective(LookAt(camera.position, camera.focalPoint, camera.viewUp),
    camera.viewAngle, 1, 0.1 * distance, 3 * distance);
  return view;
}

/// A scene with the arrays that a renderer reads.
struct Drawable
{
  const SceneOfFile& scene;
  std::vector<float> scalars;
  TransferFunctions functions;

  explicit Drawable(const SceneOfFile& source)
    : scene(source)
    , scalars(source.file.scalars.begin(), source.file.scalars.end())
    , functions(FunctionsOf(source.file))
  {
  }

  void Prepare(Renderer& renderer) const
  {
    renderer.SetScalars(this->scene.grid, this->scalars.data());
    renderer.SetTransferFunctions(this->functions);
  }

  void Light(Renderer& renderer, bool shadows = true) const
  {
    Lighting lighting;
    lighting.enabled = true;
    lighting.light = this->scene.light;
    lighting.shadows = shadows;
    renderer.SetLighting(lighting);
  }

  void Show(Renderer& renderer, const std::vector<float>& extinction) const
  {
    renderer.SetExtinction(this->scene.grid, this->scene.extinction.data(), extinction.data());
  }
};
}

#endif
