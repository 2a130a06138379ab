// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// By Google Benchmark, whose entries are kept: stream/KIND/PLACE, iteration/SCENE, pass/NAME/SCENE,
// kernel/NAME. Their counters "bytes" and "items" are those of one call: bytes of every array or
// field that is read or written, once, at the nodes that are visited; rays times layers.

#include "Measure.h"
#include "SweepCounts.h"
#include "Volume.h"

#include "backend/Backend.h"
#include "backend/Simd.h"
#include "optimize/PolicySweep.h"
#include "optimize/PreparedScene.h"
#include "optimize/Terms.h"
#include "sweep/Rows.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <sstream>

namespace limpid::benchmark
{
namespace
{
/// Registers benchmarks and runs them in turns.
class Runner
{
public:
  explicit Runner(const Options& options)
    : Repetitions(options.Flag("quick") ? 1 : options.Count("repeats"))
    , LeastSeconds(options.Flag("quick") ? 1e-3 : 0.1)
  {
    std::string words[] = { "kernels", "--benchmark_enable_random_interleaving=true" };
    char* arguments[] = { words[0].data(), words[1].data(), nullptr };
    int count = 2;
    ::benchmark::Initialize(&count, arguments);
  }

  template <class Body>
  ::benchmark::internal::Benchmark* Add(const std::string& name, const Body& body) const
  {
    return ::benchmark::RegisterBenchmark(name.c_str(), body)
      ->UseRealTime()
      ->MinTime(this->LeastSeconds)
      ->Repetitions(this->Repetitions)
      ->ReportAggregatesOnly()
      ->ComputeStatistics("spread", Spread, ::benchmark::kPercentage);
  }

  /// What a call does on one thread and, if `onAll`, on all.
  void AddCall(const std::string& name, const char* item, double items, double bytes, bool onAll,
    const std::function<void()>& call) const
  {
    for (const int threads : onAll ? std::vector<int>{ 1, ThreadCount() } : std::vector<int>{ 1 })
    {
      this->Add(name + "/threads:" + std::to_string(threads),
        [=](::benchmark::State& state)
        {
          const ThreadLimit limit(threads);
          for (auto iteration : state)
          {
            (void)iteration;
            call();
            ::benchmark::ClobberMemory();
          }
          state.SetLabel(item);
          state.counters["items"] = items;
          state.counters["bytes"] = bytes;
        });
    }
  }

  /// Moves their entries to the end of `entries`.
  static void Run(Json& entries)
  {
    std::ostringstream text;
    ::benchmark::JSONReporter reporter;
    reporter.SetOutputStream(&text);
    ::benchmark::RunSpecifiedBenchmarks(&reporter);
    ::benchmark::ClearRegisteredBenchmarks();
    const Json all = Json::parse(text.str());
    for (const Json& entry : all["benchmarks"])
    {
      const std::string kind = entry.value("aggregate_name", "median");
      if (kind == "median" || kind == "spread" || kind == "least")
      {
        Json kept;
        for (const char* key : { "run_name", "aggregate_name", "threads", "real_time", "time_unit",
               "label", "items", "bytes" })
        {
          if (entry.contains(key))
          {
            kept[key] = entry[key];
          }
        }
        entries.push_back(kept);
      }
    }
  }

private:
  int Repetitions;
  double LeastSeconds;
};

LIMPID_MULTIVERSION
float SumOf(const float* __restrict values, std::size_t count)
{
  constexpr std::size_t lanes = 128; // so many sums that no addition waits for the one before
  float sums[lanes] = {};
  for (std::size_t i = 0; i + lanes <= count; i += lanes)
  {
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      sums[lane] += values[i + lane];
    }
  }
  float total = 0;
  for (const float sum : sums)
  {
    total += sum;
  }
  return total;
}

/// `factor` is 1, but the compiler must not know: it would call the library.
LIMPID_MULTIVERSION
void CopyTo(float* __restrict out, const float* __restrict in, float factor, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    out[i] = factor * in[i];
  }
}

LIMPID_MULTIVERSION
void TriadTo(float* __restrict out, const float* __restrict first, const float* __restrict second,
  float factor, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    out[i] = first[i] + factor * second[i];
  }
}

/// Every thread has arrays of its own, in caches and in memory.
void AddStreams(const Runner& runner, bool quick)
{
  struct Stream
  {
    const char* name;
    std::size_t arrays;
    void (*pass)(float* first, std::size_t count, float factor);
  };
  static const Stream streams[] = {
    { "read", 1,
      [](float* first, std::size_t count, float)
      { ::benchmark::DoNotOptimize(SumOf(first, count)); } },
    { "copy", 2,
      [](float* first, std::size_t count, float factor)
      { CopyTo(first, first + count, factor, count); } },
    { "triad", 3,
      [](float* first, std::size_t count, float factor)
      { TriadTo(first, first + count, first + 2 * count, factor, count); } },
    { "memcpy", 2,
      [](float* first, std::size_t count, float)
      { std::memcpy(first, first + count, count * sizeof(float)); } },
  };
  const std::size_t kibi = 1024;
  const std::map<std::string, std::size_t> ofAll{ { "L3", 12 * kibi * kibi },
    { "memory", (quick ? 1 : 384) * kibi * kibi } };
  const std::map<std::string, std::size_t> ofEach{ { "L1", 24 * kibi }, { "L2", 512 * kibi } };
  const auto add = [&](const std::string& place, std::size_t bytes, int threads)
  {
    for (const Stream& stream : streams)
    {
      runner
        .Add(std::string("stream/") + stream.name + "/" + place,
          [&stream, bytes](::benchmark::State& state)
          {
            const std::size_t count = bytes / sizeof(float) / stream.arrays;
            std::vector<float> values(count * stream.arrays, 1.0f);
            float factor = 1;
            ::benchmark::DoNotOptimize(factor);
            for (auto iteration : state)
            {
              (void)iteration;
              stream.pass(values.data(), count, factor);
              ::benchmark::ClobberMemory();
            }
            state.counters["bytes"] = double(values.size() * sizeof(float)); // sum over threads
          })
        ->Threads(threads)
        ->ComputeStatistics("least",
          [](const std::vector<double>& values)
          { return *std::min_element(values.begin(), values.end()); });
    }
  };
  for (int threads = 1; threads <= ThreadCount(); threads *= 2)
  {
    for (const auto& [place, bytes] : ofEach)
    {
      add(place, bytes, threads);
    }
    for (const auto& [place, bytes] : ofAll)
    {
      add(place, bytes / std::size_t(threads), threads);
    }
  }
}

/// A row of rays and of voxels, all of which stays in the first cache.
struct RowArrays
{
  static constexpr int count = 256;
  static constexpr int readBeyond = 32; // see InterpolateRow

  RowArrays()
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
  std::vector<float> length, extinction, importance;
  std::vector<float> entry = std::vector<float>(count, -1.0f);
  std::vector<float> exit = std::vector<float>(count, 1e6f);
  std::vector<double> opticalDepth = std::vector<double>(count, 1.0);
  std::vector<float> visible = std::vector<float>(count, 0.1f);
  std::vector<float> plain = visible;
  std::vector<float> behind = visible;
};

void AddRows(const Runner& runner)
{
  const auto rows = std::make_shared<RowArrays>();
  const Range<int> all{ 0, RowArrays::count };
  const auto add =
    [&](const std::string& name, int floats, int doubles, const std::function<void()>& call)
  {
    const double bytes = RowArrays::count * (4.0 * floats + 8.0 * doubles);
    runner.AddCall("kernel/" + name, "column", RowArrays::count, bytes, false, call);
  };
  add("BlendFourRows", 5, 0,
    [=]
    {
      const float* four[2][2] = { { rows->extinction.data(), rows->importance.data() },
        { rows->length.data(), rows->visible.data() } };
      BlendFourRows(four, 0.3f, 0.2f, all.begin, all.end, rows->plain.data());
    });
  add("InterpolateRow", 4, 0,
    [=] { InterpolateRow(rows->extinction.data(), rows->map, all, rows->plain.data()); });
  // Optical depths and what is visible are read and written; the rows of both halves are the same.
  add("ForwardRow", 7, 2,
    [=]
    {
      rows->opticalDepth.assign(all.end, 1.0); // a little of the time
      ForwardRow(rows->Rays(), rows->opticalDepth.data(), rows->visible.data(), rows->plain.data());
    });
  add("BackwardRow", 7, 2,
    [=]
    {
      BackwardRow(rows->Rays(),
        { rows->behind.data(), rows->visible.data(), rows->plain.data(),
          rows->opticalDepth.data() });
    });
}

Settings EndlessSettings()
{
  Settings settings;
  settings.backend = BackendKind::Cpu;
  settings.tolerance = 0;
  settings.maximumIterations = 1000000000;
  return settings;
}

/// The passes of policy iterations one by one, as optimize/Policy.cxx makes them.
class Passes
{
public:
  explicit Passes(const SceneForSolver& scene)
    : Prepared(scene.Fields())
    , Task(this->Prepared.ProblemFor(scene.camera, scene.light, EndlessSettings()))
    , Seen(this->Task)
    , Last(scene.extinction)
    , Next(scene.extinction)
    , Lagged(scene.extinction.size())
  {
    this->Forward();
    this->Derive();
  }

  void Forward() { this->Seen.camera->Forward(this->Task.baseExtinction, this->Task.importance); }

  void Derive()
  {
    this->Seen.light->SetGradient(
      { this->Next.data(), this->Task.importance, this->Task.nodeImportance },
      this->Task.settings.derivative, this->Lagged.data());
  }

  void Optimize()
  {
    std::swap(this->Last, this->Next);
    PolicyTask task = TaskOf(this->Task, 10, 1);
    task.fields.extinction = this->Last.data();
    task.fields.lagged = this->Lagged.data();
    task.fields.next = this->Next.data();
    task.trust = Trust::LastIterate;
    VisibilityTerm& camera = *this->Seen.camera;
    for (std::size_t index = 0; index < camera.FrustumCount(); ++index)
    {
      SweepPolicy(camera.FrustumAt(index), task, camera.ImagesAt(index));
    }
    for (std::size_t index = 0; index + 1 < camera.FrustumCount(); ++index)
    {
      camera.ForwardAt(index, this->Next.data(), this->Task.importance); // met the last iterate
    }
  }

  const Problem& What() const { return this->Task; }

private:
  PreparedScene Prepared;
  Problem Task;
  Terms Seen;
  std::vector<float> Last;
  std::vector<float> Next;
  std::vector<float> Lagged;
};

/// An iteration of the solver and its passes. `volume`: what a formula is called, else empty.
Json AddScene(const Runner& runner, const SceneForSolver& scene, const std::string& volume)
{
  const auto passes = std::make_shared<Passes>(scene);
  const auto solver = std::make_shared<Solver>(scene.MakeSolver(EndlessSettings()));
  solver->Step(2); // makes memory
  const Problem& problem = passes->What();
  const SweepCounts camera = CountSweep(problem, problem.camera);
  const SweepCounts light = CountSweep(problem, problem.light);
  const NodeSet filled = FilledNodes(problem);
  NodeSet compared = filled;
  Add(camera.read, compared);
  // Rays read the next iterate and importance, voxels base, lagged derivative and importance; both
  // read the last iterate; the next one is written. Rays of all frusta but the last go through
  // extinction and importance once more.
  const double ofPolicy = 4 *
    (2 * CountOf(camera.read) + CountOf(compared) + 3 * CountOf(filled) + CountOf(camera.updated) +
      2 * camera.readAgain);
  // Rays read the extinction twice and importance, voxels importance and the derivative, which is
  // written, too.
  const double ofDerivative = 4 * 3 * (CountOf(light.read) + CountOf(light.updated));
  runner.AddCall("iteration/" + scene.name, "sample", camera.samples + light.samples,
    ofPolicy + ofDerivative, true, [=] { solver->Step(1); });
  runner.AddCall("pass/policy sweep, camera/" + scene.name, "sample", camera.samples, ofPolicy,
    true, [=] { passes->Optimize(); });
  runner.AddCall("pass/depths and derivative, light/" + scene.name, "sample", light.samples,
    ofDerivative, true, [=] { passes->Derive(); });
  if (!volume.empty())
  {
    runner.AddCall("kernel/forward sweep, " + volume, "sample", camera.samples,
      8 * CountOf(camera.read), true, [=] { passes->Forward(); });
  }
  return { { "scene", scene.name }, { "nodes", ToJson(scene.grid.nodes) },
    { "voxels", scene.grid.NodeCount() }, { "filled", problem.occupancy->FilledVoxels() } };
}
}

void MeasureKernels(const Options& options, Json& results, const std::function<void()>& save)
{
  const Runner runner(options);
  Json& entries = results["benchmarks"] = Json::array();
  AddStreams(runner, options.Flag("quick"));
  AddRows(runner);
  Say("streams, rows");
  Runner::Run(entries);
  const auto measure = [&](const SceneForSolver& scene, const std::string& volume)
  {
    Say(scene.name);
    results["scenes"].push_back(AddScene(runner, scene, volume));
    Runner::Run(results["benchmarks"]);
    save();
  };
  for (const std::string& path : options.words)
  {
    measure(SceneForSolver(truth::ReadSceneFile(path)), "");
  }
  const int side = std::min(256, options.Count("largest"));
  for (const char* filling : { "dense", "onion" })
  {
    measure(MakeVolume(filling, side), std::string(filling) + " " + std::to_string(side) + "³");
  }
}
}
