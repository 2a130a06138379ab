// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "KernelsResults.h"
#include "Machine.h"

#include <nlohmann/json.hpp>

namespace limpid::benchmark
{
namespace
{
using Json = nlohmann::ordered_json;

Json Of(const StreamRate& rate)
{
  return { { "stream", NameOf(rate.kind) }, { "place", rate.place }, { "threads", rate.threads },
    { "bytes", rate.arrays }, { "seconds", rate.seconds }, { "bytes per second", rate.rate } };
}

Json Of(const KernelTime& kernel)
{
  return { { "kernel", kernel.name }, { "threads", kernel.threads }, { "seconds", kernel.seconds },
    { "spread", kernel.spread }, { "item", kernel.item }, { "items per second", kernel.itemRate },
    { "bytes per second", kernel.byteRate } };
}

Json Of(const FloorResult& result, const std::vector<StreamRate>& streams)
{
  Json passes = Json::array();
  for (const PassTime& pass : result.passes)
  {
    passes.push_back({ { "pass", pass.name }, { "seconds", pass.seconds }, { "bytes", pass.bytes },
      { "floor", FloorOf(pass.bytes, result.threads, streams) }, { "samples", pass.samples } });
  }
  return { { "scene", result.scene },
    { "nodes", { result.nodes.x, result.nodes.y, result.nodes.z } }, { "threads", result.threads },
    { "voxels", result.voxels }, { "filled", result.filled }, { "seconds", result.seconds },
    { "spread", result.spread }, { "bytes", result.Bytes() },
    { "bytes at all filled nodes", result.fieldBytes },
    { "floor", FloorOf(result.Bytes(), result.threads, streams) }, { "passes", passes } };
}
}

void WriteKernelsJson(std::ostream& stream, const KernelsResults& results)
{
  const MachineFacts machine = FactsOfMachine();
  Json streams = Json::array();
  for (const StreamRate& rate : results.streams)
  {
    streams.push_back(Of(rate));
  }
  Json floors = Json::array();
  for (const FloorResult& result : results.floors)
  {
    floors.push_back(Of(result, results.streams));
  }
  Json kernels = Json::array();
  for (const KernelTime& kernel : results.kernels)
  {
    kernels.push_back(Of(kernel));
  }
  const Json json{ { "machine",
                     { { "processor", machine.processor }, { "cores", machine.cores },
                       { "threads", machine.threads }, { "compiler", machine.compiler },
                       { "build", machine.buildType }, { "date", machine.date },
                       { "load before", results.loadBefore },
                       { "load after", results.loadAfter } } },
    { "streams", streams }, { "iterations", floors }, { "kernels", kernels } };
  stream << json.dump(1) << "\n";
}
}
