// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "KernelsRows.h"

#include "GpuScene.h"
#include "KernelsFloor.h"
#include "Timing.h"

#include "backend/Backend.h"
#include "optimize/PolicySweep.h"
#include "optimize/PreparedScene.h"
#include "optimize/Terms.h"
#include "sweep/Rows.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>

namespace limpid::benchmark
{
namespace
{
/// What a kernel does in one call.
struct Kernel
{
  std::string name;
  std::string item;
  int threads = 1;
  double items = 0;
  double bytes = 0;
  std::function<void()> call;
};

/// A row of rays and of voxels, all of which stays in the first cache.
struct RowArrays
{
  static constexpr int count = 256;
  static constexpr int readBeyond = 32; // see InterpolateRow

  explicit RowArrays()
  {
    for (int i = 0; i < count; ++i)
    {
      this->map.index.push_back(std::min(count - 2, i * 9 / 10));
      this->map.weight.push_back(0.1f * float(i % 10));
      this->length.push_back(1.0f + 1e-3f * float(i));
      this->extinction.push_back(0.5f + 0.4f * std::sin(0.05f * float(i)));
      this->importance.push_back(0.5f + 0.4f * std::cos(0.03f * float(i)));
    }
    this->extinction.resize(count + readBeyond);
    this->importance.resize(count + readBeyond);
    this->entry.resize(count, -1.0f);
    this->exit.resize(count, 1e6f);
    this->opticalDepth.resize(count, 1.0);
    this->visible.resize(count, 0.1f);
    this->plain.resize(count, 0.1f);
    this->behind.resize(count, 0.1f);
  }

  RayRow Rays() const
  {
    RayRow rays{};
    rays.layer = { 0, 1, 0.99f, 1 };
    rays.row = { -1, 1e6f };
    rays.columnEntry = this->entry.data();
    rays.columnExit = this->exit.data();
    rays.length = this->length.data();
    rays.extinction[0] = rays.extinction[1] = this->extinction.data();
    rays.importance[0] = rays.importance[1] = this->importance.data();
    rays.work = rays.inside = { 0, count };
    return rays;
  }

  LinearMap map;
  std::vector<float> length;
  std::vector<float> extinction;
  std::vector<float> importance;
  std::vector<float> entry;
  std::vector<float> exit;
  std::vector<double> opticalDepth;
  std::vector<float> visible;
  std::vector<float> plain;
  std::vector<float> behind;
};

/// Bytes of `floats` and `doubles` arrays of a row.
double RowBytes(int floats, int doubles)
{
  return RowArrays::count * (4.0 * floats + 8.0 * doubles);
}

void AddRows(std::vector<Kernel>& kernels)
{
  const auto rows = std::make_shared<RowArrays>();
  const auto add = [&](const std::string& name, double bytes, std::function<void()> call) {
    kernels.push_back({ name, "column", 1, RowArrays::count, bytes, std::move(call) });
  };
  const Range<int> all{ 0, RowArrays::count };
  add("BlendFourRows", RowBytes(5, 0),
    [=]
    {
      const float* four[2][2] = { { rows->extinction.data(), rows->importance.data() },
        { rows->length.data(), rows->visible.data() } };
      BlendFourRows(four, 0.3f, 0.2f, all.begin, all.end, rows->plain.data());
    });
  add("InterpolateRow", RowBytes(4, 0),
    [=] { InterpolateRow(rows->extinction.data(), rows->map, all, rows->plain.data()); });
  // Optical depths and what is visible are read and written; the rows of both halves are the same.
  add("ForwardRow", RowBytes(7, 2),
    [=]
    {
      rows->opticalDepth.assign(all.end, 1.0); // a little of the time
      ForwardRow(rows->Rays(), rows->opticalDepth.data(), rows->visible.data(), rows->plain.data());
    });
  add("DeepenRow", RowBytes(2, 2), [=] { DeepenRow(rows->Rays(), rows->opticalDepth.data()); });
  add("UnwindRow", RowBytes(2, 2), [=] { UnwindRow(rows->Rays(), rows->opticalDepth.data()); });
  // Visible importance, its bound and optical depths are read and written.
  const auto behind = [=]
  {
    return RaysBehind{ rows->behind.data(), rows->visible.data(), rows->plain.data(),
      rows->opticalDepth.data() };
  };
  add("BackwardRow", RowBytes(7, 2), [=] { BackwardRow(rows->Rays(), behind()); });
  add("CollectRow", RowBytes(7, 2), [=] { CollectRow(rows->Rays(), behind()); });
  add("RearHalfRow", RowBytes(5, 0),
    [=] { RearHalfRow(rows->Rays(), rows->visible.data(), rows->plain.data()); });
  add("TransmitRow", RowBytes(1, 1),
    [=] { TransmitRow(rows->opticalDepth.data(), all, rows->plain.data()); });
}

/// A scene with the sweeps of its camera and light.
struct SweptScene
{
  SweptScene(Filling filling, int side)
    : volume(filling, side)
    , prepared(volume.Fields())
    , problem(prepared.ProblemFor(volume.camera, volume.light, OnProcessor()))
    , terms(problem)
    , last(volume.extinction)
    , next(volume.extinction)
    , lagged(volume.extinction.size())
  {
    this->Forward();
  }

  static Settings OnProcessor()
  {
    Settings settings;
    settings.backend = BackendKind::Cpu;
    return settings;
  }

  void Forward()
  {
    this->terms.camera->Forward(this->problem.baseExtinction, this->problem.importance);
  }

  void Derive()
  {
    this->terms.light->SetGradient(
      { this->problem.baseExtinction, this->problem.importance, this->problem.nodeImportance },
      this->problem.settings.derivative, this->lagged.data());
  }

  /// From the iterate that the last call has found.
  void Optimize()
  {
    std::swap(this->last, this->next);
    PolicyTask task = TaskOf(this->problem, 10, 1);
    task.fields.extinction = this->last.data();
    task.fields.lagged = this->lagged.data();
    task.fields.next = this->next.data();
    task.trust = Trust::LastIterate;
    VisibilityTerm& camera = *this->terms.camera;
    for (std::size_t index = 0; index < camera.FrustumCount(); ++index)
    {
      SweepPolicy(camera.FrustumAt(index), task, camera.ImagesAt(index));
    }
  }

  GpuScene volume;
  PreparedScene prepared;
  Problem problem;
  Terms terms;
  std::vector<float> last;
  std::vector<float> next;
  std::vector<float> lagged;
};

void AddSweeps(Filling filling, const KernelEffort& effort, std::vector<Kernel>& kernels)
{
  const auto scene = std::make_shared<SweptScene>(filling, effort.side);
  const SweepCounts camera = CountSweep(scene->problem, scene->problem.camera);
  const SweepCounts light = CountSweep(scene->problem, scene->problem.light);
  const NodeSet filled = FilledNodes(scene->problem);
  const std::string where = ", " + NameOf(filling) + " " + std::to_string(effort.side) + "³";
  const int all = ThreadCount();
  for (int threads = 1; threads <= all; threads += all > 1 ? all - 1 : 1)
  {
    kernels.push_back({ "forward sweep" + where, "sample", threads, camera.samples,
      8 * CountOf(camera.read), [=] { scene->Forward(); } });
    kernels.push_back({ "depths and derivative" + where, "sample", threads, light.samples,
      BytesOfDerivative(light), [=] { scene->Derive(); } });
    kernels.push_back({ "policy sweep" + where, "sample", threads, camera.samples,
      BytesOfPolicy(camera, filled), [=] { scene->Optimize(); } });
  }
}

/// Keeps the seconds of all repetitions.
class Collector : public ::benchmark::BenchmarkReporter
{
public:
  bool ReportContext(const Context&) override { return true; }

  void ReportRuns(const std::vector<Run>& runs) override
  {
    for (const Run& run : runs)
    {
      if (run.run_type == Run::RT_Iteration && run.iterations > 0)
      {
        this->Seconds[run.run_name.function_name].push_back(
          run.real_accumulated_time / double(run.iterations));
      }
    }
  }

  std::map<std::string, std::vector<double>> Seconds;
};

/// Names are those of Google Benchmark's filters and have to be different.
std::string KeyOf(const Kernel& kernel)
{
  return kernel.name + ", threads " + std::to_string(kernel.threads);
}

void Register(const Kernel& kernel, const KernelEffort& effort)
{
  const auto body = [kernel](::benchmark::State& state)
  {
    const ThreadLimit limit(kernel.threads);
    for (auto iteration : state)
    {
      (void)iteration;
      kernel.call();
      ::benchmark::ClobberMemory();
    }
  };
  ::benchmark::RegisterBenchmark(KeyOf(kernel).c_str(), body)
    ->UseRealTime()
    ->MinTime(effort.leastSeconds)
    ->Repetitions(effort.repetitions);
}
}

std::vector<KernelTime> MeasureKernels(const KernelEffort& effort)
{
  std::vector<Kernel> kernels;
  AddRows(kernels);
  for (const Filling filling : { Filling::Dense, Filling::Onion })
  {
    AddSweeps(filling, effort, kernels);
  }
  for (const Kernel& kernel : kernels)
  {
    Register(kernel, effort);
  }
  std::string program = "kernels";
  std::string inTurns = "--benchmark_enable_random_interleaving=true";
  char* arguments[] = { program.data(), inTurns.data(), nullptr };
  int count = 2;
  ::benchmark::Initialize(&count, arguments);
  Collector collector;
  ::benchmark::RunSpecifiedBenchmarks(&collector);

  std::vector<KernelTime> times;
  for (const Kernel& kernel : kernels)
  {
    const std::vector<double>& seconds = collector.Seconds[KeyOf(kernel)];
    const double median = Median(seconds);
    times.push_back({ kernel.name, kernel.item, kernel.threads, median, Spread(seconds),
      kernel.items / median, kernel.bytes / median });
  }
  return times;
}
}
