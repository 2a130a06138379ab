// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Drawing.h"
#include "Measure.h"

#include "energy/VisibilityTerm.h"
#include "optimize/Progressive.h"

#include <cmath>
#include <ctime>

namespace limpid::benchmark
{
namespace
{
constexpr int stillSize = 1024; // pixels along each side
constexpr int movingSize = 384;
constexpr double previewTime = 0.05; // of a frame [s]
constexpr int movingFrames = 20;

/// The camera after a turn about the vertical.
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

/// A still picture, everything from the start. A picture of one pixel takes no time for its ray.
Json TimeStages(const Drawable& drawable, const std::vector<float>& extinction, int repeats)
{
  const View whole = ViewOf(drawable.scene.camera, stillSize);
  const View pixel = ViewOf(drawable.scene.camera, 1);
  Picture picture;
  Rounds rounds;
  for (int repeat = -1; repeat < repeats; ++repeat)
  {
    Renderer renderer;
    Stopwatch watch;
    const auto lap = [&](const char* stage) { rounds[stage].push_back(watch.Lap()); };
    renderer.SetScalars(drawable.scene.grid, drawable.scalars.data());
    lap("scalars");
    renderer.SetTransferFunctions(drawable.functions);
    drawable.Show(renderer, extinction);
    lap("functions");
    drawable.Light(renderer, false);
    renderer.Render(pixel, picture);
    lap("gradient and bricks");
    drawable.Light(renderer);
    renderer.Render(pixel, picture);
    lap("shadow");
    renderer.Render(whole, picture);
    lap("rays");
    if (repeat < 0) // it warms up
    {
      rounds.clear();
    }
  }
  return MediansOf(rounds);
}

/// Samples between entry and exit of all rays of a picture, nothing left out.
double SamplesOf(const Grid& grid, const View& view)
{
  const double step = std::min({ grid.spacing.x, grid.spacing.y, grid.spacing.z });
  double samples = 0;
  for (int pixel = 0; pixel < view.width * view.height; ++pixel)
  {
    const int column = pixel % view.width;
    const int row = pixel / view.width;
    const auto point = [&](double z)
    {
      const glm::dvec4 x = view.clipToWorld *
        glm::dvec4(2 * (column + 0.5) / view.width - 1, 2 * (row + 0.5) / view.height - 1, z, 1.0);
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

struct PictureTime
{
  double seconds;
  double cpuSeconds; ///< of all threads: another program on the machine adds less to it
};

/// CPU time of all threads since std::clock() returned `before` [s].
double CpuSecondsSince(std::clock_t before)
{
  return double(std::clock() - before) / CLOCKS_PER_SEC;
}

PictureTime TimeOf(Renderer& renderer, const View& view, int repeats)
{
  Picture picture;
  renderer.Render(view, picture);
  std::vector<double> seconds;
  std::vector<double> cpuSeconds;
  for (int repeat = 0; repeat < repeats; ++repeat)
  {
    Stopwatch watch;
    const std::clock_t before = std::clock();
    renderer.Render(view, picture);
    cpuSeconds.push_back(CpuSecondsSince(before));
    seconds.push_back(watch.Lap());
  }
  return { Median(seconds), Median(cpuSeconds) };
}

/// The rays of one picture.
Json TimeRays(const Drawable& drawable, const std::vector<float>& extinction, int repeats)
{
  View view = ViewOf(drawable.scene.camera, stillSize);
  Renderer renderer;
  drawable.Prepare(renderer);
  drawable.Show(renderer, extinction);
  Picture picture;
  renderer.Render(view, picture);
  const std::size_t pixels = picture.rgba.size() / 4;
  std::size_t empty = 0;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
  {
    empty += picture.rgba[4 * pixel + 3] == 0 ? 1 : 0;
  }
  Json times{ { "samples", SamplesOf(drawable.scene.grid, view) },
    { "empty_share", double(empty) / double(pixels) } };
  const auto time = [&](const std::string& name)
  {
    const PictureTime taken = TimeOf(renderer, view, repeats);
    times[name] = taken.seconds;
    times[name + "_cpu"] = taken.cpuSeconds;
  };
  time("unlit");
  drawable.Light(renderer, false);
  time("lit");
  drawable.Light(renderer);
  time("shadowed");
  view.skipEmpty = false;
  view.opaqueBelow = 0;
  time("every_sample");
  return times;
}

/// A still picture by every method, as a display draws it, in turns [CPU s].
Json TimeMethods(const Drawable& drawable, int repeats)
{
  const SceneOfFile& scene = drawable.scene;
  std::array<Renderer, methodCount> renderers;
  std::array<std::array<FoundExtinction, 2>, methodCount> extinctions;
  for (int method = 0; method < methodCount; ++method)
  {
    Settings settings;
    settings.method = static_cast<Method>(method);
    const MethodInfo& info = InfoOf(settings.method);
    Renderer& renderer = renderers[std::size_t(method)];
    drawable.Prepare(renderer);
    drawable.Light(renderer, info.castsShadows);
    renderer.ComposeBy(info.compositing);
    if (info.compositing != Compositing::FrontToBack)
    {
      renderer.SetImportance(scene.importance.data());
    }
    else if (settings.method != Method::Ordinary)
    {
      Solver solver = scene.MakeSolver(settings);
      solver.Run();
      auto& found = extinctions[std::size_t(method)] = solver.TakeExtinctions();
      const std::vector<float>& ofLight = found[1].OnHost();
      renderer.SetExtinction(scene.grid, scene.extinction.data(), found[0].OnHost().data(), 1,
        ofLight.empty() ? nullptr : ofLight.data());
    }
    renderer.Prepare();
  }
  const View view = ViewOf(scene.camera, stillSize);
  Rounds rounds;
  Picture picture;
  for (int repeat = -1; repeat < repeats; ++repeat)
  {
    for (int method = 0; method < methodCount; ++method)
    {
      const std::clock_t before = std::clock();
      renderers[std::size_t(method)].Render(view, picture);
      if (repeat >= 0) // the first picture warms up
      {
        rounds[InfoOf(static_cast<Method>(method)).name].push_back(CpuSecondsSince(before));
      }
    }
  }
  return MediansOf(rounds);
}

/// Frames of an orbit: one pass of the optimisation on a coarse grid, a small picture.
Json TimeMoving(const Drawable& drawable)
{
  const SceneOfFile& scene = drawable.scene;
  Progressive progressive(scene.Fields(), Settings());
  Renderer renderer;
  drawable.Prepare(renderer);
  drawable.Light(renderer);
  Rounds rounds;
  Picture picture;
  for (int frame = -10; frame < movingFrames; ++frame) // the first learn what a pass takes
  {
    if (frame == 0)
    {
      rounds.clear();
    }
    const Camera camera = Turned(scene.camera, 2.0 * frame);
    Stopwatch whole;
    Stopwatch watch;
    const auto lap = [&](const char* stage) { rounds[stage].push_back(watch.Lap()); };
    progressive.SetView(camera, scene.light, Settings());
    progressive.Preview(previewTime);
    lap("optimisation");
    renderer.SetExtinction(progressive.ShownGrid(), progressive.BaseExtinction(),
      progressive.Extinction(), 0.5, progressive.LightExtinction());
    renderer.Render(ViewOf(camera, 1), picture);
    lap("shadow");
    renderer.Render(ViewOf(camera, movingSize), picture);
    lap("rays");
    rounds["frame"].push_back(whole.Lap());
  }
  Json result{ { "nodes", ToJson(progressive.ShownGrid().nodes) },
    { "longest", *std::max_element(rounds["frame"].begin(), rounds["frame"].end()) } };
  result.update(MediansOf(rounds));
  return result;
}

/// One sweep from the camera, one ray per voxel and axis, and an unlit picture of as many pixels.
Json TimeFewRays(const Drawable& drawable, int repeats)
{
  const SceneOfFile& scene = drawable.scene;
  const float* extinction = scene.extinction.data();
  const Occupancy occupancy(scene.grid, extinction, extinction, true);
  VisibilityTerm<HostDevice> term(
    HostDevice::Shared(), scene.grid, occupancy, SourceOfCamera(scene.camera, scene.grid, true), 1);
  Index rays = 0;
  for (const FrustumRays<HostDevice>& frustum : term.Frusta())
  {
    rays += frustum.Plan().RayCount();
  }
  std::vector<double> seconds;
  for (int repeat = -1; repeat < repeats; ++repeat)
  {
    Seen seen;
    Stopwatch watch;
    term.Forward({ extinction, extinction }, &seen);
    const double sum = watch.Lap();
    if (repeat >= 0) // the first run warms up
    {
      seconds.push_back(sum);
    }
  }
  Renderer renderer;
  drawable.Prepare(renderer);
  const int size = int(std::lround(std::sqrt(double(rays))));
  return { { "rays", rays }, { "sweep", Median(seconds) },
    { "cast", TimeOf(renderer, ViewOf(scene.camera, size), repeats).seconds } };
}
}

Json MeasureRendering(const SceneOfFile& scene, const Options& options)
{
  const int repeats = options.Count("repeats");
  const Drawable drawable(scene);
  Json result{ { "scene", scene.name }, { "nodes", ToJson(scene.grid.nodes) },
    { "pixels", stillSize },
    { "rays", { { "base", TimeRays(drawable, scene.extinction, repeats) } } } };
  if (!options.Has("parts", "stages"))
  {
    return result;
  }
  Solver solver = scene.MakeSolver(Settings());
  solver.Run();
  const std::vector<float> optimized = solver.Extinction();
  result["rays"]["optimised"] = TimeRays(drawable, optimized, repeats);
  result.update({ { "moving_pixels", movingSize }, { "frames", movingFrames },
    { "preview_seconds", previewTime }, { "still", TimeStages(drawable, optimized, repeats) },
    { "methods", TimeMethods(drawable, repeats) }, { "moving", TimeMoving(drawable) },
    { "few_rays", TimeFewRays(drawable, repeats) } });
  return result;
}
}
