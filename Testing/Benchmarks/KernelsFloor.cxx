// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "KernelsFloor.h"

#include "Timing.h"
#include "Traffic.h"

#include "backend/Backend.h"
#include "optimize/PolicySweep.h"
#include "optimize/PreparedScene.h"
#include "optimize/Terms.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace limpid::benchmark
{
namespace
{
const char* const policy = "policy sweep, camera";
const char* const derivative = "depths and derivative, light";

/// Runs the passes of policy iterations one by one, as PolicyOnCpu of optimize/Policy.cxx does.
class TimedIterations
{
public:
  explicit TimedIterations(const Problem& problem)
    : Task(problem)
    , Seen(problem)
    , Last(problem.baseExtinction, problem.baseExtinction + problem.grid.NodeCount())
    , Next(this->Last)
    , Lagged(this->Last.size(), 0.0f)
  {
    this->Sweep(nullptr, Trust::Clear);
    this->Derive();
  }

  void Iterate()
  {
    std::swap(this->Last, this->Next);
    Stopwatch watch;
    this->Sweep(this->Lagged.data(), Trust::LastIterate);
    this->Times[policy].push_back(watch.Lap());
    this->Derive();
    this->Times[derivative].push_back(watch.Lap());
  }

  double MedianOf(const std::string& pass) const { return Median(this->Times.at(pass)); }

private:
  void Sweep(const float* lagged, Trust trust)
  {
    const Weights& weights = this->Task.settings.weights;
    PolicyTask task = TaskOf(this->Task, weights.view, lagged ? weights.light : 0.0);
    task.fields.extinction = this->Last.data();
    task.fields.lagged = lagged;
    task.fields.next = this->Next.data();
    task.trust = trust;
    VisibilityTerm& camera = *this->Seen.camera;
    const std::size_t frusta = camera.FrustumCount();
    for (std::size_t index = 0; index < frusta; ++index)
    {
      SweepPolicy(camera.FrustumAt(index), task, camera.ImagesAt(index));
    }
    for (std::size_t index = 0; index + 1 < frusta; ++index) // they have met the last iterate
    {
      camera.ForwardAt(index, this->Next.data(), this->Task.importance);
    }
  }

  void Derive()
  {
    this->Seen.light->SetGradient(
      { this->Next.data(), this->Task.importance, this->Task.nodeImportance },
      this->Task.settings.derivative, this->Lagged.data());
  }

  const Problem& Task;
  Terms Seen;
  std::vector<float> Last;
  std::vector<float> Next;
  std::vector<float> Lagged;
  std::map<std::string, std::vector<double>> Times;
};

std::vector<PassTime> TimePasses(const Problem& problem, int iterations)
{
  TimedIterations timed(problem);
  for (int iteration = 0; iteration < iterations; ++iteration)
  {
    timed.Iterate();
  }
  const SweepCounts camera = CountSweep(problem, problem.camera);
  const SweepCounts light = CountSweep(problem, problem.light);
  return { { policy, timed.MedianOf(policy), BytesOfPolicy(camera, FilledNodes(problem)),
             camera.samples },
    { derivative, timed.MedianOf(derivative), BytesOfDerivative(light), light.samples } };
}

double TotalOf(const Traffic& traffic)
{
  return std::accumulate(traffic.begin(), traffic.end(), 0.0,
    [](double sum, const auto& launches) { return sum + launches.second; });
}
}

// Rays read the next iterate and importance, voxels base, lagged derivative and importance; both
// read the last iterate; the next one is written. Rays of all frusta but the last go through
// extinction and importance once more.
double BytesOfPolicy(const SweepCounts& camera, const NodeSet& filled)
{
  NodeSet compared = filled;
  Add(camera.read, compared);
  return 4 *
    (2 * CountOf(camera.read) + CountOf(compared) + 3 * CountOf(filled) + CountOf(camera.updated) +
      2 * camera.readAgain);
}

// Rays read the extinction twice and importance, voxels importance and the derivative, which is
// written, too.
double BytesOfDerivative(const SweepCounts& light)
{
  return 4 * 3 * (CountOf(light.read) + CountOf(light.updated));
}

double FloorResult::Bytes() const
{
  return std::accumulate(this->passes.begin(), this->passes.end(), 0.0,
    [](double sum, const PassTime& pass) { return sum + pass.bytes; });
}

double FloorResult::SecondsOfPasses() const
{
  return std::accumulate(this->passes.begin(), this->passes.end(), 0.0,
    [](double sum, const PassTime& pass) { return sum + pass.seconds; });
}

FloorResult MeasureFloor(const TimedScene& scene, int iterations)
{
  FloorResult result;
  result.scene = scene.name;
  result.nodes = scene.fields.grid.nodes;
  result.threads = ThreadCount();
  result.voxels = double(scene.fields.grid.NodeCount());
  Settings settings;
  settings.backend = BackendKind::Cpu;
  settings.tolerance = 0; // all iterations
  settings.maximumIterations = iterations + 2;
  Solver solver(scene.fields, scene.camera, scene.light, settings);
  std::vector<double> seconds;
  solver.Step(2); // makes memory
  for (int iteration = 0; iteration < iterations; ++iteration)
  {
    Stopwatch watch;
    solver.Step(1);
    seconds.push_back(watch.Lap());
  }
  result.seconds = Median(seconds);
  result.spread = Spread(seconds);
  PreparedScene prepared(scene.fields);
  const Problem problem = prepared.ProblemFor(scene.camera, scene.light, settings);
  result.filled = double(problem.occupancy->FilledVoxels());
  result.fieldBytes = TotalOf(PolicyTraffic(problem, Runner::Processor));
  result.passes = TimePasses(problem, iterations);
  return result;
}
}
