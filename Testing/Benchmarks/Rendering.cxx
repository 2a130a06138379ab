// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Rendering.h"

#include "Markdown.h"
#include "SceneFunctions.h"
#include "Timing.h"
#include "Viewing.h"

#include "optimize/Progressive.h"
#include "render/Renderer.h"
#include "scene/RaySource.h"
#include "sweep/Sweep.h"

#include <algorithm>
#include <cmath>

namespace limpid::benchmark
{
namespace
{
constexpr int stillSize = 1024; // pixels along each side
constexpr int movingSize = 384;
constexpr double previewTime = 0.05; // of a frame [s]
constexpr int movingFrames = 20;

/// The picture that the scene's camera sees after a turn about the vertical [degrees].
View ViewOf(const Camera& camera, int size)
{
  const double distance = glm::length(camera.position - camera.focalPoint);
  View view;
  view.width = view.height = size;
  view.clipToWorld = Perspective(LookAt(camera.position, camera.focalPoint, camera.viewUp),
    camera.viewAngle, 1, 0.1 * distance, 3 * distance);
  return view;
}

Camera Turned(const Camera& camera, double degrees)
{
  const double angle = degrees * std::acos(-1.0) / 180;
  const Vec3 axis = glm::normalize(camera.viewUp);
  const Vec3 way = camera.position - camera.focalPoint;
  Camera turned = camera;
  turned.position = camera.focalPoint + std::cos(angle) * way +
    std::sin(angle) * glm::cross(axis, way) + (1 - std::cos(angle)) * glm::dot(axis, way) * axis;
  return turned;
}

/// A scene with the arrays that the renderer reads.
struct Drawable
{
  const Scene& scene;
  std::vector<float> scalars;
  TransferFunctions functions;
  std::vector<float> optimized;

  explicit Drawable(const Scene& source)
    : scene(source)
    , scalars(source.file.scalars.begin(), source.file.scalars.end())
    , functions(FunctionsOf(source.file))
  {
    Solver solver = source.MakeSolver(Settings());
    solver.Run();
    optimized = solver.Extinction();
  }

  Lighting Light(bool shadows = true) const
  {
    Lighting lighting;
    lighting.enabled = true;
    lighting.light = scene.light;
    lighting.shadows = shadows;
    return lighting;
  }

  void Show(Renderer& renderer, const std::vector<float>& extinction) const
  {
    renderer.SetExtinction(scene.grid, scene.file.extinction.data(), extinction.data());
  }
};

StillTimes TimeStages(const Drawable& drawable, int repeats)
{
  std::vector<double> scalars, functions, shadow, prepared, rays;
  const View whole = ViewOf(drawable.scene.camera, stillSize);
  const View pixel = ViewOf(drawable.scene.camera, 1);
  Picture picture;
  for (int repeat = -1; repeat < repeats; ++repeat) // the first run warms up
  {
    Renderer renderer;
    Stopwatch watch;
    renderer.SetScalars(drawable.scene.grid, drawable.scalars.data());
    const double toScalars = watch.Lap();
    renderer.SetTransferFunctions(drawable.functions);
    drawable.Show(renderer, drawable.optimized);
    const double toFunctions = watch.Lap();
    renderer.SetLighting(drawable.Light());
    renderer.LightTransmittanceAt(drawable.scene.grid.Centre());
    const double toShadow = watch.Lap();
    renderer.Render(pixel, picture);
    const double toPrepared = watch.Lap();
    renderer.Render(whole, picture);
    const double toRays = watch.Lap();
    if (repeat >= 0)
    {
      scalars.push_back(toScalars);
      functions.push_back(toFunctions);
      shadow.push_back(toShadow);
      prepared.push_back(toPrepared);
      rays.push_back(toRays);
    }
  }
  return { Median(scalars), Median(functions), Median(shadow), Median(prepared), Median(rays),
    Spread(rays) };
}

/// Samples between entry and exit of all rays of a picture, nothing left out.
double SamplesOf(const Scene& scene, const View& view)
{
  const Grid& grid = scene.grid;
  const double step = std::min({ grid.spacing.x, grid.spacing.y, grid.spacing.z });
  double samples = 0;
  for (int pixel = 0; pixel < view.width * view.height; ++pixel)
  {
    const auto point = [&](double z)
    {
      const glm::dvec4 x = view.clipToWorld *
        glm::dvec4(2 * (pixel % view.width + 0.5) / view.width - 1,
          2 * (pixel / view.width + 0.5) / view.height - 1, z, 1.0);
      return grid.PointToIndex(Vec3(x) / x.w);
    };
    const Vec3 from = point(-1);
    const Vec3 way = point(1) - from;
    const Vec3 low = -from / way;
    const Vec3 high = (Vec3(grid.nodes) - 1.0 - from) / way;
    const Vec3 entries = glm::min(low, high);
    const Vec3 exits = glm::max(low, high);
    const double inside = std::min({ 1.0, exits.x, exits.y, exits.z }) -
      std::max({ 0.0, entries.x, entries.y, entries.z });
    samples += std::max(0.0, inside) * glm::length(way * grid.spacing) / step;
  }
  return samples;
}

double TimeOf(Renderer& renderer, const View& view, int repeats)
{
  Picture picture;
  renderer.Render(view, picture);
  std::vector<double> seconds;
  for (int repeat = 0; repeat < repeats; ++repeat)
  {
    Stopwatch watch;
    renderer.Render(view, picture);
    seconds.push_back(watch.Lap());
  }
  return Median(seconds);
}

RayTimes TimeRays(const Drawable& drawable, const std::vector<float>& extinction, int repeats)
{
  RayTimes times;
  View view = ViewOf(drawable.scene.camera, stillSize);
  times.samples = SamplesOf(drawable.scene, view);
  Renderer renderer;
  renderer.SetScalars(drawable.scene.grid, drawable.scalars.data());
  renderer.SetTransferFunctions(drawable.functions);
  drawable.Show(renderer, extinction);
  Picture picture;
  renderer.Render(view, picture);
  const std::size_t pixels = picture.rgba.size() / 4;
  std::size_t empty = 0;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
  {
    empty += picture.rgba[4 * pixel + 3] == 0 ? 1 : 0;
  }
  times.emptyShare = double(empty) / double(pixels);
  times.unlit = TimeOf(renderer, view, repeats);
  renderer.SetLighting(drawable.Light(false));
  times.lit = TimeOf(renderer, view, repeats);
  renderer.SetLighting(drawable.Light());
  times.shadowed = TimeOf(renderer, view, repeats);
  view.skipEmpty = false;
  view.opaqueBelow = 0;
  times.whole = TimeOf(renderer, view, repeats);
  return times;
}

MovingTimes TimeMoving(const Drawable& drawable)
{
  const Scene& scene = drawable.scene;
  Progressive progressive(scene.Fields(), Settings());
  Renderer renderer;
  renderer.SetScalars(scene.grid, drawable.scalars.data());
  renderer.SetTransferFunctions(drawable.functions);
  renderer.SetLighting(drawable.Light());
  std::vector<double> optimization, shadow, rays, frames;
  MovingTimes times;
  Picture picture;
  for (int frame = -10; frame < movingFrames; ++frame) // the first learn what a pass takes
  {
    const Camera camera = Turned(scene.camera, 2.0 * frame);
    Stopwatch watch;
    progressive.SetView(camera, scene.light, Settings());
    progressive.Preview(previewTime);
    const double toOptimization = watch.Lap();
    times.nodes = progressive.ShownGrid().nodes;
    renderer.SetExtinction(progressive.ShownGrid(), progressive.BaseExtinction(),
      progressive.Extinction(), 0.5, progressive.LightExtinction());
    renderer.LightTransmittanceAt(scene.grid.Centre());
    const double toShadow = watch.Lap();
    renderer.Render(ViewOf(camera, movingSize), picture);
    const double toRays = watch.Lap();
    if (frame >= 0)
    {
      optimization.push_back(toOptimization);
      shadow.push_back(toShadow);
      rays.push_back(toRays);
      frames.push_back(toOptimization + toShadow + toRays);
    }
  }
  times.optimization = Median(optimization);
  times.shadow = Median(shadow);
  times.rays = Median(rays);
  times.frame = Median(frames);
  times.longest = *std::max_element(frames.begin(), frames.end());
  return times;
}

FewRaysTimes TimeFewRays(const Drawable& drawable, int repeats)
{
  const Scene& scene = drawable.scene;
  const float* extinction = scene.file.extinction.data();
  const Occupancy occupancy(scene.grid, extinction, extinction, true);
  FewRaysTimes times;
  std::vector<double> sweeps;
  for (int repeat = -1; repeat < repeats; ++repeat) // the first run warms up
  {
    const std::vector<FaceFrustum> frusta =
      PlanSweep(scene.grid, occupancy, SourceOfCamera(scene.camera, scene.grid, true), 1);
    times.rays = 0;
    double seconds = 0;
    for (const FaceFrustum& frustum : frusta)
    {
      RayImages images(frustum);
      Stopwatch watch;
      SweepForward(frustum, { &scene.grid, &occupancy, extinction, extinction }, images);
      seconds += watch.Lap();
      times.rays += frustum.RayCount();
    }
    if (repeat >= 0)
    {
      sweeps.push_back(seconds);
    }
  }
  times.sweep = Median(sweeps);
  Renderer renderer;
  renderer.SetScalars(scene.grid, drawable.scalars.data());
  renderer.SetTransferFunctions(drawable.functions);
  const int size = int(std::lround(std::sqrt(double(times.rays))));
  times.cast = TimeOf(renderer, ViewOf(scene.camera, size), repeats);
  return times;
}

void WriteStill(std::ostream& stream, const std::vector<RenderingResult>& results)
{
  Table table({ "scene", "nodes", "scalars [ms]", "functions, extinction [ms]",
    "shadow volume [ms]", "gradient, bricks [ms]", "rays [ms]", "all [ms]", "spread of rays" });
  bool noisy = false;
  for (const RenderingResult& result : results)
  {
    const StillTimes& times = result.still;
    const double all = times.scalars + times.functions + times.shadow + times.prepared + times.rays;
    noisy |= times.spread > 0.2;
    table.Add({ result.scene, Sizes(result.nodes), Milliseconds(times.scalars),
      Milliseconds(times.functions), Milliseconds(times.shadow), Milliseconds(times.prepared),
      Milliseconds(times.rays), Milliseconds(all), Fixed(100 * times.spread, 0) + " %" });
  }
  stream << "\n## A still picture, stage by stage\n\n"
         << stillSize << " × " << stillSize
         << " pixels, lit, with shadows, of the optimised extinction, everything from the start.\n";
  table.Write(stream);
  if (noisy)
  {
    stream << "**The machine was busy while this was measured (a spread above 20 %): all times are "
              "preliminary.**\n\n";
  }
}

void WriteRays(std::ostream& stream, const std::vector<RenderingResult>& results)
{
  Table table({ "scene", "extinction", "samples on all rays [millions]", "empty pixels",
    "unlit [ms]", "lit [ms]", "with shadows [ms]", "every sample taken [ms]", "[million samples/s]",
    "time left out" });
  for (const RenderingResult& result : results)
  {
    for (const RayTimes* times : { &result.base, &result.optimized })
    {
      table.Add({ result.scene, times == &result.base ? "base" : "optimised",
        Fixed(1e-6 * times->samples, 0), Fixed(100 * times->emptyShare, 0) + " %",
        Milliseconds(times->unlit), Milliseconds(times->lit), Milliseconds(times->shadowed),
        Milliseconds(times->whole), Fixed(1e-6 * times->samples / times->whole, 0),
        Fixed(100 * (1 - times->shadowed / times->whole), 0) + " %" });
    }
  }
  stream << "\n## Rays\n\n"
         << "Of the same picture. The last three columns: with shadows, nothing skipped and no ray "
            "ended early; the samples per second of that; and how much of its time is saved.\n";
  table.Write(stream);
}

void WriteMoving(std::ostream& stream, const std::vector<RenderingResult>& results)
{
  Table table({ "scene", "optimised on", "optimisation [ms]", "extinction, shadow volume [ms]",
    "rays [ms]", "frame [ms]", "longest frame [ms]" });
  for (const RenderingResult& result : results)
  {
    const MovingTimes& times = result.moving;
    table.Add({ result.scene, Sizes(times.nodes), Milliseconds(times.optimization),
      Milliseconds(times.shadow), Milliseconds(times.rays), Milliseconds(times.frame),
      Milliseconds(times.longest) });
  }
  stream << "\n## A moving frame\n\n"
         << movingSize << " × " << movingSize << " pixels, lit, with shadows; " << movingFrames
         << " frames, each 2 degrees on, with " << Milliseconds(previewTime)
         << " ms for one pass of the optimisation. Medians.\n";
  table.Write(stream);
}

void WriteFewRays(std::ostream& stream, const std::vector<RenderingResult>& results)
{
  Table table({ "scene", "rays", "one sweep [ms]", "as many pixels cast [ms]", "sweep / cast" });
  for (const RenderingResult& result : results)
  {
    const FewRaysTimes& times = result.fewRays;
    table.Add({ result.scene, std::to_string(times.rays), Milliseconds(times.sweep),
      Milliseconds(times.cast), Fixed(times.sweep / times.cast, 1) });
  }
  stream << "\n## Few rays, or a sweep\n\n"
         << "A picture composited by a sweep from slice to slice and warped to the screen has the "
            "rays of the sweep, here one per voxel and axis; the same number of rays can be cast "
            "through pixels. Base extinction, unlit. The sweep sums extinction and importance "
            "only: colours and light would come on top.\n";
  table.Write(stream);
}
}

RenderingResult MeasureRendering(const Scene& scene, const Options& options)
{
  const Drawable drawable(scene);
  RenderingResult result;
  result.scene = scene.file.name;
  result.nodes = scene.grid.nodes;
  result.still = TimeStages(drawable, options.repeats);
  result.base = TimeRays(drawable, scene.file.extinction, options.repeats);
  result.optimized = TimeRays(drawable, drawable.optimized, options.repeats);
  result.moving = TimeMoving(drawable);
  result.fewRays = TimeFewRays(drawable, options.repeats);
  return result;
}

void WriteRendering(std::ostream& stream, const std::vector<RenderingResult>& results)
{
  WriteStill(stream, results);
  WriteRays(stream, results);
  WriteMoving(stream, results);
  WriteFewRays(stream, results);
}
}
