// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Measure.h"
#include "Viewing.h"

#include "render/RendererOnDevice.h"

#include <algorithm>

namespace limpid::benchmark
{
namespace
{
using Device = CompiledDevice;

/// Blue to yellow with more and more extinction; the scalar is the extinction.
TransferFunctions FunctionsOf(float largest)
{
  TransferFunctions functions;
  functions.low = 0;
  functions.high = largest;
  constexpr int last = 256;
  for (int entry = 0; entry <= last; ++entry)
  {
    const float share = float(entry) / last;
    functions.extinction.push_back(share * largest);
    functions.color.push_back({ { share, 0.2f + 0.6f * share, 1 - 0.7f * share } });
  }
  return functions;
}

/// From the scene's camera, turned about the scene by an angle [radians].
View ViewOf(const SceneForSolver& scene, int side, double angle)
{
  const Vec3 centre = scene.grid.Centre();
  const Vec3 away = scene.camera.position - centre;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const Vec3 turned(c * away.x + s * away.z, away.y, c * away.z - s * away.x);
  const double radius = scene.grid.Radius();
  View view;
  view.width = view.height = side;
  view.clipToWorld = Perspective(LookAt(centre + turned, centre, Vec3(0, 1, 0)),
    scene.camera.viewAngle, 1, 1.5 * radius, 6 * radius);
  return view;
}

Lighting LightingOf(const SceneForSolver& scene)
{
  Lighting lighting;
  lighting.enabled = true;
  lighting.light = scene.light;
  return lighting;
}
}

void MeasurePictures(const std::shared_ptr<Device>& device, const SceneForSolver& scene,
  const std::vector<float>& extinction, const Effort& effort, Json& result)
{
  Renderer renderer(PicturesOn(device));
  renderer.SetScalars(scene.grid, scene.extinction.data());
  renderer.SetTransferFunctions(
    FunctionsOf(*std::max_element(scene.extinction.begin(), scene.extinction.end())));
  renderer.SetLighting(LightingOf(scene));
  const DeviceArray<Device, float> base(device, scene.extinction, "the base extinction");
  const DeviceArray<Device, float> found(device, extinction, "the extinction");
  Picture picture;
  int frame = 0;
  const auto draw = [&]
  {
    renderer.Render(ViewOf(scene, effort.pictureSide, 0.002 * ++frame), picture);
    device->Wait();
  };
  result["picture"] = Repeat(effort, 2,
    [&]
    {
      renderer.ShowThere(scene.grid, base.Data(), found.Data());
      draw();
    });
  result["picture_at_rest"] = Repeat(effort, 2, draw);
}
}
