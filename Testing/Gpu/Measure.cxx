// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Measure.h"

#include "MeasurePictures.h"
#include "Repeat.h"
#include "Traffic.h"

#include "backend/Backend.h"
#include "backend/CompiledDevice.h"
#include "optimize/EngineOnDevice.h"
#include "optimize/FieldsOnDevice.h"
#include "optimize/PreparedScene.h"
#include "sweep/Plan.h"
#include "viewpoint/Search.h"

#include <cmath>
#include <initializer_list>
#include <memory>
#include <vector>

namespace limpid::benchmark
{
namespace
{
using Device = CompiledDevice;

/// Another one for everything, so that its memory is told apart.
std::shared_ptr<Device> MakeDevice()
{
  return std::make_shared<Device>(FindCuda().device);
}

/// A scene and what stays when the camera moves.
struct Prepared
{
  Prepared(const GpuScene& fields, const Settings& wanted)
    : scene(&fields)
    , settings(wanted)
    , values(fields.Fields())
  {
    this->settings.mode = Mode::Joint;
    this->problem = this->values.ProblemFor(fields.camera, fields.light, this->settings);
    this->problem.resident = std::make_shared<Resident>();
  }

  std::unique_ptr<Minimizer> Begin(Engine& engine, bool warm = false) const
  {
    return engine.MakeMinimizer(this->problem, std::vector<float>(this->scene->extinction), warm);
  }

  const GpuScene* scene;
  Settings settings;
  PreparedScene values;
  Problem problem;
};

std::vector<Part> PartsOf(const LaunchTimes& times, int iterations, const Traffic& traffic)
{
  std::vector<Part> parts;
  for (const LaunchTimes::Entry& entry : times.Entries())
  {
    const auto bytes = traffic.find(entry.label);
    parts.push_back({ entry.label, double(entry.count) / iterations, entry.seconds / iterations,
      bytes == traffic.end() ? 0.0 : bytes->second });
  }
  return parts;
}

/// Iterations after the first ones, which allocate.
IterationResult MeasureIterations(
  const Prepared& prepared, const Traffic& traffic, const Effort& effort)
{
  constexpr int warmUps = 4;
  const std::shared_ptr<Device> device = MakeDevice();
  const std::shared_ptr<Engine> engine = EngineOn(device);
  IterationResult result;
  const std::unique_ptr<Minimizer> minimizer = prepared.Begin(*engine);
  minimizer->Start();
  result.wall = Repeat(effort, warmUps, [&] { minimizer->Iterate(); });
  LaunchTimes times;
  const int timed = result.wall.repetitions;
  device->Time(&times);
  for (int iteration = 0; iteration < timed; ++iteration)
  {
    minimizer->Iterate();
  }
  device->Time(nullptr);
  result.parts = PartsOf(times, timed, traffic);
  for (const Part& part : result.parts)
  {
    result.bytes += part.bytes;
  }
  result.deviceMemory = device->PeakBytes();
  return result;
}

IterationResult TryIterations(
  const Prepared& prepared, const Traffic& traffic, const Effort& effort)
{
  try
  {
    return MeasureIterations(prepared, traffic, effort);
  }
  catch (const std::exception& error)
  {
    IterationResult result;
    result.wall.missing = error.what();
    return result;
  }
}

Settings OfAdam()
{
  Settings settings;
  settings.solver = SolverKind::Adam;
  settings.iterationsPerLevel = { { 0, 0, 1000000 } };
  return settings;
}

void MeasureSetUp(const GpuScene& scene, const Effort& effort, SceneResult& result)
{
  Effort few = effort;
  few.repetitions = 5;
  result.prepare = Try([&] { return Repeat(few, 1, [&] { Prepared(scene, Settings()); }); });
  const Prepared prepared(scene, Settings());
  const Problem& problem = prepared.problem;
  result.filled = double(problem.occupancy->FilledVoxels()) / double(scene.grid.NodeCount());
  result.plan = Try(
    [&]
    {
      return Repeat(effort, 1,
        [&]
        {
          for (const RaySource& eye : { problem.camera, problem.light })
          {
            PlanSweep(problem.grid, *problem.occupancy, eye, problem.settings.rayDensity);
          }
        });
    });
  result.upload = Try(
    [&]
    {
      const std::shared_ptr<Device> device = MakeDevice();
      return Repeat(few, 1,
        [&]
        {
          const FieldsOnDevice<Device> fields(device, problem);
          device->Wait();
        });
    });
}

/// As every frame does it when the camera has moved: the fields are there, the result stays there.
std::vector<float> MeasureRun(const GpuScene& scene, const Effort& effort, SceneResult& result)
{
  const Prepared prepared(scene, Settings());
  const std::shared_ptr<Device> device = MakeDevice();
  const std::shared_ptr<Engine> engine = EngineOn(device);
  const auto fields = FieldsOnDevice<Device>::Of(device, prepared.problem);
  result.begin = Repeat(effort, 2,
    [&]
    {
      const auto minimizer = prepared.Begin(*engine);
      device->Wait();
    });
  std::unique_ptr<Minimizer> minimizer;
  const auto run = [&]
  {
    minimizer = prepared.Begin(*engine);
    minimizer->Start();
    result.runIterations = 0;
    while (!minimizer->Converged() && result.runIterations < minimizer->IterationLimit())
    {
      minimizer->Iterate();
      ++result.runIterations;
    }
    device->Wait();
  };
  result.run = Repeat(effort, 2, run);
  std::vector<float> found;
  Effort once = effort;
  once.repetitions = 1;
  result.download = Repeat(once, 0, [&] { found = minimizer->TakeBest(); });
  return found;
}

/// Directions all over a sphere, about equally far apart.
std::vector<Vec3> Directions(int count)
{
  const double turn = std::acos(-1.0) * (3 - std::sqrt(5.0));
  std::vector<Vec3> directions;
  for (int n = 0; n < count; ++n)
  {
    const double height = 1 - (2 * n + 1.0) / count;
    const double radius = std::sqrt(1 - height * height);
    directions.emplace_back(radius * std::cos(n * turn), height, radius * std::sin(n * turn));
  }
  return directions;
}

/// Of the importance proxy, as the viewpoint search does it.
Figure MeasureSphere(const GpuScene& scene, const Effort& effort)
{
  std::vector<float> proxy(scene.importance.size());
  for (std::size_t node = 0; node < proxy.size(); ++node)
  {
    proxy[node] = scene.largest * scene.importance[node];
  }
  const ViewScore score(scene.grid, proxy.data(), scene.importance.data(), 1.0, BackendKind::Cuda);
  Orbit orbit;
  orbit.centre = scene.grid.Centre();
  orbit.distance = 3 * scene.grid.Radius();
  const std::vector<Vec3> directions = Directions(effort.directions);
  Effort few = effort;
  few.repetitions = 3;
  return Repeat(few, 1, [&] { ScoreViews(score, orbit, directions, [](double) { return true; }); });
}

Figure MeasureProcessor(const GpuScene& scene, const Effort& effort)
{
  const Prepared prepared(scene, Settings());
  const auto minimizer = prepared.Begin(*CpuEngine());
  minimizer->Start();
  Effort few = effort;
  few.repetitions = 5;
  return Repeat(few, 2, [&] { minimizer->Iterate(); });
}

/// Why there are no figures but those that there are.
void Explain(const std::exception& error, std::initializer_list<Figure*> figures)
{
  for (Figure* figure : figures)
  {
    if (!figure->Measured())
    {
      figure->missing = error.what();
    }
  }
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
}

DeviceResult MeasureDevice(const Effort& effort)
{
  const std::shared_ptr<Device> device = MakeDevice();
  DeviceResult result;
  result.name = device->Name();
  result.copyBytes = 2.0 * effort.copySize;
  result.copy = Try(
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

SceneResult MeasureScene(const GpuScene& scene, const Effort& effort)
{
  SceneResult result;
  result.name = scene.name;
  result.nodes = scene.grid.nodes.x;
  MeasureSetUp(scene, effort, result);
  {
    const Prepared prepared(scene, Settings());
    result.policy = TryIterations(prepared, PolicyTraffic(prepared.problem), effort);
  }
  {
    const Prepared prepared(scene, OfAdam());
    result.adam = TryIterations(prepared, AdamTraffic(prepared.problem), effort);
  }
  try
  {
    const std::vector<float> found = MeasureRun(scene, effort, result);
    MeasurePictures(MakeDevice(), scene, found, effort, result);
  }
  catch (const std::exception& error)
  {
    Explain(error,
      { &result.begin, &result.run, &result.download, &result.picture, &result.pictureAtRest });
  }
  result.directions = effort.directions;
  result.sphere = Try([&] { return MeasureSphere(scene, effort); });
  result.processor = Try([&] { return MeasureProcessor(scene, effort); });
  return result;
}
}
