// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Machine.h"
#include "ScalingResults.h"

#include <nlohmann/json.hpp>

namespace limpid::benchmark
{
namespace
{
using Json = nlohmann::ordered_json;

Json Of(const StepTimes& times)
{
  Json json;
  for (const Step step : allSteps)
  {
    json[NameOf(step)] = times[step];
  }
  return json;
}

Json Of(const VolumeMemory& volume)
{
  return { { "scene", volume.scene }, { "side", volume.side }, { "voxels", volume.usage.voxels },
    { "bytes", volume.usage.bytes } };
}

Json Of(const SizeResult& size)
{
  return { { "scene", size.scene }, { "side", size.side }, { "seconds", Of(size.times.seconds) },
    { "spread", Of(size.times.spread) } };
}

Json Of(const Exponents& fit)
{
  return { { "scene", fit.scene }, { "smallest", fit.smallest }, { "largest", fit.largest },
    { "exponents", Of(fit.values) } };
}

Json Of(const ThreadResult& result)
{
  Json times = Json::array();
  for (std::size_t i = 0; i < result.threads.size(); ++i)
  {
    times.push_back({ { "threads", result.threads[i] }, { "seconds", Of(result.times[i].seconds) },
      { "spread", Of(result.times[i].spread) } });
  }
  StepTimes efficiencies;
  for (const Step step : allSteps)
  {
    efficiencies[step] = result.Efficiency(step);
  }
  return { { "scene", result.scene },
    { "nodes", { result.nodes.x, result.nodes.y, result.nodes.z } }, { "times", times },
    { "efficiency", Of(efficiencies) }, { "cores", result.cores } };
}

Json Of(const SampleCounts& counts)
{
  return { { "taken", counts.taken }, { "all", counts.all } };
}

Json Of(const RunTimes& times)
{
  return { { "setup", times.setup }, { "first pass", times.first }, { "iteration", times.later },
    { "whole run", times.whole } };
}

Json Of(const SkipResult& result)
{
  return { { "scene", result.scene }, { "voxels", result.voxels }, { "filled", result.filled },
    { "read by camera", result.seenByCamera }, { "read by light", result.seenByLight },
    { "touched", result.touched }, { "voxels skipped", result.VoxelsSkipped() },
    { "camera samples", Of(result.camera) }, { "light samples", Of(result.light) },
    { "samples skipped", result.SamplesSkipped() }, { "iterations", result.time.iterations },
    { "seconds on", Of(result.time.withSkips) }, { "seconds off", Of(result.time.withoutSkips) },
    { "spread", result.time.spread } };
}

template <class Item>
Json ListOf(const std::vector<Item>& items)
{
  Json list = Json::array();
  for (const Item& item : items)
  {
    list.push_back(Of(item));
  }
  return list;
}
}

void WriteScalingJson(std::ostream& stream, const ScalingResults& results)
{
  const MachineFacts machine = FactsOfMachine();
  const Json json{ { "machine",
                     { { "processor", machine.processor }, { "cores", machine.cores },
                       { "threads", machine.threads }, { "compiler", machine.compiler },
                       { "build", machine.buildType }, { "date", machine.date },
                       { "load before", results.loadBefore },
                       { "load after", results.loadAfter } } },
    { "sizes", ListOf(results.sizes) }, { "exponents", ListOf(results.exponents) },
    { "memory", ListOf(results.memory) }, { "threads", ListOf(results.threads) },
    { "skips", ListOf(results.skips) } };
  stream << json.dump(1) << "\n";
}
}
