// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// By Google Benchmark, whose entries are kept: stream/KIND/PLACE, iteration/SCENE, pass/NAME/SCENE,
// kernel/NAME. Their counters are those of one call: "bytes" of every array or field that is read
// or written, once, at the nodes that are visited; "items" are samples, rays times layers.

#include "Measure.h"
#include "SweepCounts.h"
#include "Volume.h"

#include "backend/Backend.h"
#include "backend/Simd.h"
#include "optimize/PolicySweep.h"
#include "optimize/PreparedScene.h"

#include <benchmark/benchmark.h>

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

  /// What a call does on one thread and on all.
  void AddCall(
    const std::string& name, double samples, double bytes, const std::function<void()>& call) const
  {
    for (const int threads : { 1, ThreadCount() })
    {
      this->Add(name + "/threads:" + std::to_string(threads),
        [=](::benchmark::State& state)
        {
          const ThreadLimit limit(threads);
          for (auto iteration : state)
          {
            (void)iteration;
            call();
          }
          state.counters["items"] = samples;
          state.counters["bytes"] = bytes;
        });
      if (ThreadCount() == 1)
      {
        break;
      }
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
    for (Json entry : all["benchmarks"])
    {
      const std::string kind = entry.value("aggregate_name", "median");
      if (kind == "median" || kind == "spread" || kind == "least")
      {
        for (const char* key : { "name", "family_index", "per_family_instance_index", "run_type",
               "repetitions", "repetition_index", "aggregate_unit", "iterations" })
        {
          entry.erase(key);
        }
        entries.push_back(entry);
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
  for (int threads = 1; threads <= ThreadCount(); threads *= 2)
  {
    const auto share = std::size_t(threads);
    const std::map<std::string, std::size_t> kibibytes{ { "L1", 24 }, { "L2", 512 },
      { "L3", 12 * 1024 / share }, { "memory", (quick ? 1 : 384) * 1024 / share } };
    for (const auto& [place, size] : kibibytes)
    {
      for (const Stream& stream : streams)
      {
        const auto body = [&stream, bytes = size * 1024](::benchmark::State& state)
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
        };
        runner.Add(std::string("stream/") + stream.name + "/" + place, body)
          ->Threads(threads)
          ->ComputeStatistics("least",
            [](const std::vector<double>& values)
            { return *std::min_element(values.begin(), values.end()); });
      }
    }
  }
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
    , Given(this->Prepared.ProblemFor(scene.camera, scene.light, EndlessSettings()))
    , Energy(HostDevice::Shared(), this->Given)
    , Last(scene.extinction)
    , Next(scene.extinction)
    , Lagged(scene.extinction.size())
  {
    this->Forward();
    this->Derive();
  }

  void Forward()
  {
    this->Energy.all.front().Forward(
      { this->Given.baseExtinction, this->Given.importance }, &this->Met);
  }

  void Derive()
  {
    this->Energy.DifferentiateTerm(
      this->Energy.all.back(), this->Next.data(), 0, this->Lagged.data());
  }

  void Optimize()
  {
    std::swap(this->Last, this->Next);
    ExactDifferences moved;
    SweepPolicy(*HostDevice::Shared(), this->Energy.all.front(), this->Energy, this->Given,
      { this->Last.data(), this->Lagged.data(), this->Next.data(), 10, this->Energy.Pulls(),
        Transmittance::OfLastIterate, Kept::Counted },
      moved);
  }

  const Problem& What() const { return this->Given; }

private:
  PreparedScene Prepared;
  Problem Given;
  Terms<HostDevice> Energy;
  std::vector<float> Last;
  std::vector<float> Next;
  std::vector<float> Lagged;
  Seen Met;
};

/// The sweeps of a scene, and with `floor` also an iteration of the solver. `volume`: what a
/// formula is called, else empty.
Json AddScene(
  const Runner& runner, const SceneForSolver& scene, const std::string& volume, bool floor)
{
  const auto passes = std::make_shared<Passes>(scene);
  const Problem& problem = passes->What();
  const SweepCounts camera = CountSweep(problem, problem.Camera());
  const SweepCounts light = CountSweep(problem, problem.Light());
  const double filled = CountOf(FilledNodes(problem));
  NodeSet compared = FilledNodes(problem);
  Add(camera.read, compared);
  // Rays read the next iterate and importance, voxels base, lagged derivative and importance; both
  // read the last iterate; the next one is written. Rays of all frusta but the last go through
  // extinction and importance once more.
  const double ofPolicy = 4 *
    (2 * CountOf(camera.read) + CountOf(compared) + 3 * filled + CountOf(camera.updated) +
      2 * camera.readAgain);
  // Rays read the extinction twice and importance, voxels importance and the derivative, which is
  // written, too.
  const double ofDerivative = 4 * 3 * (CountOf(light.read) + CountOf(light.updated));
  const auto add = [&](const std::string& name, const char* eye, double samples, double bytes,
                     const std::function<void()>& call)
  {
    if (floor && *eye)
    {
      runner.AddCall("pass/" + name + eye + "/" + scene.name, samples, bytes, call);
    }
    if (!volume.empty())
    {
      runner.AddCall("kernel/" + name + ", " + volume, samples, bytes, call);
    }
  };
  add("forward sweep", "", camera.samples, 8 * CountOf(camera.read), [=] { passes->Forward(); });
  add("depths and derivative", ", light", light.samples, ofDerivative, [=] { passes->Derive(); });
  add("policy sweep", ", camera", camera.samples, ofPolicy, [=] { passes->Optimize(); });
  if (floor)
  {
    const auto solver = std::make_shared<Solver>(scene.MakeSolver(EndlessSettings()));
    solver->Step(2); // makes memory
    runner.AddCall("iteration/" + scene.name, camera.samples + light.samples,
      ofPolicy + ofDerivative, [=] { solver->Step(1); });
  }
  return { { "scene", scene.name }, { "nodes", ToJson(scene.grid.nodes) },
    { "voxels", scene.grid.NodeCount() }, { "filled", problem.occupancy->FilledVoxels() } };
}
}

void MeasureKernels(const Options& options, Json& results, const std::function<void()>& save)
{
  const Runner runner(options);
  results["benchmarks"] = Json::array();
  Say("streams");
  AddStreams(runner, options.Flag("quick"));
  Runner::Run(results["benchmarks"]);
  const auto measure = [&](const SceneForSolver& scene, const std::string& volume, bool floor)
  {
    Say(scene.name);
    const Json facts = AddScene(runner, scene, volume, floor);
    if (floor)
    {
      results["scenes"].push_back(facts);
    }
    Runner::Run(results["benchmarks"]);
    save();
  };
  for (const std::string& path : options.words)
  {
    measure(SceneForSolver(truth::ReadSceneFile(path)), "", true);
  }
  const int large = std::min(256, options.Count("largest"));
  for (const int side : { large, 32 }) // small ones stay in caches
  {
    for (const std::string filling : { "dense", "onion" })
    {
      measure(MakeVolume(filling, side), filling + " " + std::to_string(side) + "³", side == large);
    }
  }
}
}
