// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Measure.h"

#include "TestedDevice.h"
#include "Traffic.h"
#include "Viewing.h"
#include "Volume.h"

#include "backend/Backend.h"
#include "backend/ComputeBackend.h"
#include "math/Require.h"
#include "optimize/PreparedScene.h"
#include "optimize/ProblemFields.h"
#include "optimize/Progressive.h"
#include "optimize/SolverBackend.h"
#include "render/RenderPasses.h"
#include "sweep/PlanOutline.h"

namespace limpid::benchmark
{
namespace
{
using Device = TestedDevice;

/// A scene and what stays when the camera moves.
struct Prepared
{
  Prepared(const SceneForSolver& fields, const Settings& wanted)
    : scene(&fields)
    , settings(wanted)
    , values(fields.Fields())
  {
    this->settings.mode = Mode::Joint;
    this->problem = this->values.ProblemFor(fields.camera, fields.light, this->settings);
    this->problem.resident = std::make_shared<Resident>();
  }

  std::unique_ptr<Minimizer> Begin(SolverBackend& backend, bool warm = false) const
  {
    return backend.MakeMinimizer(this->problem, {}, warm);
  }

  const SceneForSolver* scene;
  Settings settings;
  PreparedScene values;
  Problem problem;
};

/// Launches of a kind in one iteration, by the device's own clock. Bytes: see Traffic.h; 0: they
/// are not counted.
Json PartsOf(const LaunchTimes& times, double iterations, const Traffic& traffic)
{
  Json parts = Json::array();
  for (const LaunchTimes::Entry& entry : times.Entries())
  {
    const auto bytes = traffic.find(entry.label);
    parts.push_back({ { "label", entry.label }, { "launches", double(entry.count) / iterations },
      { "seconds", entry.seconds / iterations }, { "waits", entry.waits / iterations },
      { "copied", entry.bytes / iterations },
      { "bytes", bytes == traffic.end() ? 0.0 : bytes->second } });
  }
  return parts;
}

/// Iterations of fresh runs after the first ones, which allocate and weigh; none that comes after
/// the last one.
Json MeasureIterations(const Prepared& prepared, const Traffic& traffic, const Effort& effort)
{
  constexpr int warmUps = 2;
  const std::shared_ptr<Device> device = MakeTestedDevice();
  const std::unique_ptr<SolverBackend> backend = MakeSolverBackend(device);
  std::vector<double> seconds;
  double total = 0;
  const auto run = [&](LaunchTimes* times)
  {
    const std::unique_ptr<Minimizer> minimizer = prepared.Begin(*backend);
    minimizer->Start();
    const auto wanted = static_cast<std::size_t>(effort.repetitions);
    for (int n = 0; n < minimizer->IterationLimit() && !minimizer->Converged() &&
         seconds.size() < wanted && (total < effort.mostSeconds || n <= warmUps);
         ++n)
    {
      device->Time(n < warmUps ? nullptr : times);
      Stopwatch watch;
      minimizer->Iterate();
      device->Wait();
      if (n >= warmUps)
      {
        seconds.push_back(watch.Lap());
        total += seconds.back();
      }
    }
    device->Time(nullptr);
  };
  for (std::size_t before = 0; seconds.empty() || before < seconds.size();)
  {
    before = seconds.size();
    run(nullptr);
  }
  Json result = FigureOf(seconds);
  seconds.clear();
  total = 0;
  LaunchTimes times;
  run(&times);
  result["parts"] = PartsOf(times, double(seconds.size()), traffic);
  result["device_memory"] = device->PeakBytes();
  return result;
}

Settings OfAdam()
{
  Settings settings;
  settings.solver = SolverKind::Adam;
  settings.iterationsPerLevel = { { 0, 0, 1000000 } };
  return settings;
}

void MeasureSetUp(const SceneForSolver& scene, const Effort& effort, Json& result)
{
  const Effort few = effort.With(5);
  result["prepare"] = Try([&] { return Repeat(few, 1, [&] { Prepared(scene, Settings()); }); });
  const Prepared prepared(scene, Settings());
  const Problem& problem = prepared.problem;
  result["filled"] = double(problem.occupancy->FilledVoxels()) / double(scene.grid.NodeCount());
  result["plan"] = Try(
    [&]
    {
      return Repeat(effort, 1,
        [&]
        {
          for (const RaySource& source : { problem.Camera(), problem.Light() })
          {
            OutlineSweep(problem.grid, source, { problem.settings.rayDensity });
          }
        });
    });
  result["upload"] = Try(
    [&]
    {
      const std::shared_ptr<Device> device = MakeTestedDevice();
      return Repeat(few, 1,
        [&]
        {
          const ProblemFields<Device> fields(device, problem);
          device->Wait();
        });
    });
}

/// As every frame does it when the camera has moved: the fields are there, the result stays there.
std::vector<float> MeasureRun(const SceneForSolver& scene, const Effort& effort, Json& result)
{
  const Prepared prepared(scene, Settings());
  const std::shared_ptr<Device> device = MakeTestedDevice();
  const std::unique_ptr<SolverBackend> backend = MakeSolverBackend(device);
  const auto fields = ProblemFields<Device>::Of(device, prepared.problem);
  result["begin"] = Repeat(effort, 2,
    [&]
    {
      const auto minimizer = prepared.Begin(*backend);
      device->Wait();
    });
  std::unique_ptr<Minimizer> minimizer;
  int iterations = 0;
  const auto run = [&]
  {
    minimizer = prepared.Begin(*backend);
    minimizer->Start();
    iterations = 0;
    while (!minimizer->Converged() && iterations < minimizer->IterationLimit())
    {
      minimizer->Iterate();
      ++iterations;
    }
    device->Wait();
  };
  result["run"] = Repeat(effort, 2, run);
  result["run_iterations"] = iterations;
  std::vector<float> found;
  result["download"] = Repeat(effort.With(1), 0, [&] { found = minimizer->TakeBest(); });
  return found;
}

/// Measures the scores of many directions with the importance proxy, as the viewpoint search does
/// it.
Json MeasureSphere(const SceneForSolver& scene, const Effort& effort)
{
  const std::vector<float> proxy = scene.Proxy();
  const ViewScore score(
    scene.grid, { proxy.data(), scene.importance.data() }, 1.0, BackendKind::Cuda);
  const std::vector<Vec3> directions = SpreadDirections(effort.directions);
  return Repeat(effort.With(3), 1,
    [&] { ScoreViews(score, OrbitAround(scene.grid), directions, [](double) { return true; }); });
}

Json MeasureProcessor(const SceneForSolver& scene, const Effort& effort)
{
  const Prepared prepared(scene, Settings());
  const auto minimizer = prepared.Begin(*MakeSolverBackend(HostDevice::Shared()));
  minimizer->Start();
  return Repeat(effort.With(5), 2, [&] { minimizer->Iterate(); });
}

/// Memory may be faster with zeros than with what looks like data.
std::vector<unsigned> Noise(int bytes)
{
  std::vector<unsigned> values(std::size_t(bytes) / sizeof(unsigned));
  ParallelFor(static_cast<Index>(values.size()), 65536,
    [&](Index index)
    {
      const auto n = static_cast<unsigned>(index) * 2654435761u;
      values[std::size_t(index)] = (n ^ (n >> 15)) * 2246822519u;
    });
  return values;
}
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

/// The place of the scene's camera, turned about the scene by an angle [radians].
Vec3 Turned(const SceneForSolver& scene, double angle)
{
  const Vec3 centre = scene.grid.Centre();
  const Vec3 away = scene.camera.position - centre;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return centre + Vec3(c * away.x + s * away.z, away.y, c * away.z - s * away.x);
}

/// From there.
View ViewOf(const SceneForSolver& scene, int side, double angle)
{
  const Vec3 centre = scene.grid.Centre();
  const double radius = scene.grid.Radius();
  View view;
  view.width = view.height = side;
  view.clipToWorld = Perspective(LookAt(Turned(scene, angle), centre, Vec3(0, 1, 0)),
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

/// A renderer of the scene on the device that all share, lit, with shadows.
Renderer MakeRenderer(std::unique_ptr<RenderBackend> backend, const SceneForSolver& scene)
{
  Renderer renderer(std::move(backend));
  renderer.SetScalars(scene.grid, scene.extinction.data());
  renderer.SetTransferFunctions(
    FunctionsOf(*std::max_element(scene.extinction.begin(), scene.extinction.end())));
  renderer.SetLighting(LightingOf(scene));
  return renderer;
}

/// Measures pictures of the scene with the optimized extinction [1/length].
void MeasurePictures(const std::shared_ptr<Device>& device, const SceneForSolver& scene,
  const std::vector<float>& extinction, const Effort& effort, Json& result)
{
  Renderer renderer = MakeRenderer(std::make_unique<RenderPasses<Device>>(device), scene);
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

/// The product's own frame after the camera has moved: the whole optimisation, shadows, picture.
Json MeasureFrame(const SceneForSolver& scene, const Effort& effort)
{
  Settings settings;
  settings.backend = BackendKind::Cuda;
  Progressive progressive(scene.Fields(), settings);
  Renderer renderer = MakeRenderer(CudaBackend().MakeRenderBackend(), scene);
  Picture picture;
  double angle = 0;
  const auto frame = [&]
  {
    angle += 0.002;
    Camera camera = scene.camera;
    camera.position = Turned(scene, angle);
    progressive.SetView(camera, scene.light, settings);
    while (!progressive.Refine())
    {
    }
    const ShownOnDevice there = progressive.OnDevice();
    LIMPID_EXPECT(there.light != nullptr);
    renderer.ShowThere(progressive.ShownGrid(), there.fields.base, there.fields.extinction);
    renderer.Render(ViewOf(scene, effort.pictureSide, angle), picture);
  };
  Json result = Repeat(effort, 1, frame);
  const std::shared_ptr<Device> device = Device::Shared();
  LaunchTimes times;
  device->Time(&times);
  frame();
  device->Time(nullptr);
  result["parts"] = PartsOf(times, 1, {});
  result["iterations"] = progressive.Iterations();
  result["device_memory"] = device->PeakBytes();
  return result;
}

/// A whole run, pictures of its result, and frames of the display.
void MeasureView(const SceneForSolver& scene, const Effort& effort, Json& result,
  const std::function<void()>& save)
{
  try
  {
    const std::vector<float> found = MeasureRun(scene, effort, result);
    save();
    MeasurePictures(MakeTestedDevice(), scene, found, effort, result);
    save();
    result["frame"] = MeasureFrame(scene, effort);
  }
  catch (const std::exception& error)
  {
    for (const char* name : { "begin", "run", "download", "picture", "picture_at_rest", "frame" })
    {
      if (result[name].contains("missing"))
      {
        result[name]["missing"] = error.what();
      }
    }
  }
}
}

Json MeasureDevice(const Effort& effort)
{
  const std::shared_ptr<Device> device = MakeTestedDevice();
  Json result{ { "device", device->Name() }, { "copy_bytes", 2.0 * effort.copySize } };
  result["copy"] = Try(
    [&]
    {
      const DeviceArray<Device, unsigned> from(device, Noise(effort.copySize), "a copy");
      DeviceArray<Device, unsigned> to(device, from.Size(), "a copy");
      return Repeat(effort, 3,
        [&]
        {
          to.CopyFrom(from);
          device->Wait();
        });
    });
  return result;
}

void MeasureScene(const SceneForSolver& scene, const Effort& effort,
  const std::vector<std::string>& parts, Json& result, const std::function<void()>& save)
{
  result = { { "scene", scene.name }, { "nodes", scene.grid.nodes.x },
    { "directions", effort.directions } };
  for (const char* name : { "policy", "begin", "run", "download", "picture", "picture_at_rest",
         "frame", "prepare", "plan", "upload", "adam", "processor", "sphere" })
  {
    result[name]["missing"] = "Not measured: no time was left, or not asked for.";
  }
  // Saves what part `name` has found, or why it could not.
  const auto measure = [&](const char* name, const std::function<void()>& work)
  {
    if (!parts.empty() && std::find(parts.begin(), parts.end(), name) == parts.end())
    {
      return;
    }
    try
    {
      work();
    }
    catch (const std::exception& error)
    {
      result[name] = { { "missing", error.what() } };
    }
    save();
  };
  result["filled"] = 0;
  measure("policy",
    [&]
    {
      const Prepared prepared(scene, Settings());
      result["policy"] = MeasureIterations(prepared, PolicyTraffic(prepared.problem), effort);
    });
  measure("frame", [&] { MeasureView(scene, effort, result, save); });
  measure("set-up", [&] { MeasureSetUp(scene, effort, result); });
  measure("adam",
    [&]
    {
      const Prepared prepared(scene, OfAdam());
      result["adam"] = MeasureIterations(prepared, AdamTraffic(prepared.problem), effort);
    });
  measure("processor", [&] { result["processor"] = MeasureProcessor(scene, effort); });
  measure("sphere", [&] { result["sphere"] = MeasureSphere(scene, effort); });
}
}
