// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "KernelsResults.h"

#include "Markdown.h"

#include <algorithm>

namespace limpid::benchmark
{
namespace
{
std::string Gigabytes(double rate)
{
  return Significant(rate / 1e9, 3);
}

std::string Percent(double share)
{
  return Fixed(100 * share, 0) + " %";
}

void WriteStreams(std::ostream& stream, const std::vector<StreamRate>& rates)
{
  stream << "\n## What memory could do\n\n"
         << "The fastest of several rounds of plain loops over arrays of floats, compiled as the "
            "row kernels are: read (sum of an array), copy (one to another), triad (a sum of two "
            "to a third), and the library's memcpy. Bytes: every array once. Every thread has "
            "arrays of its own; KiB: all of them.\n";
  Table table({ "arrays are in", "threads", "[KiB]", "read [GB/s]", "copy [GB/s]", "triad [GB/s]",
    "memcpy [GB/s]" });
  constexpr std::size_t kinds = 4; // one after the other for every place
  for (std::size_t first = 0; first + kinds <= rates.size(); first += kinds)
  {
    const StreamRate& rate = rates[first];
    std::vector<std::string> row{ rate.place, std::to_string(rate.threads),
      Fixed(double(rate.arrays) / 1024, 0) };
    for (std::size_t kind = 0; kind < kinds; ++kind)
    {
      row.push_back(Gigabytes(rates[first + kind].rate));
    }
    table.Add(row);
  }
  table.Write(stream);
}

std::vector<std::string> RowOfTotal(
  const std::string& name, const FloorResult& result, double seconds, double floor)
{
  return { name, Significant(result.Bytes() / 1e6, 3),
    Significant(result.Bytes() / result.filled, 3), Milliseconds(floor), Milliseconds(seconds),
    Fixed(seconds / floor, 1), "", "" };
}

void WritePasses(
  std::ostream& stream, const FloorResult& result, const std::vector<StreamRate>& streams)
{
  stream << "\n### " << result.scene << ", " << Sizes(result.nodes) << ", " << result.threads
         << (result.threads == 1 ? " thread" : " threads") << "\n";
  Table table({ "pass", "[MB]", "[byte/filled voxel]", "floor [ms]", "measured [ms]",
    "measured / floor", "samples [10⁶]", "[ns/sample]" });
  for (const PassTime& pass : result.passes)
  {
    const double floor = FloorOf(pass.bytes, result.threads, streams);
    table.Add({ pass.name, Significant(pass.bytes / 1e6, 3),
      Significant(pass.bytes / result.filled, 3), Milliseconds(floor), Milliseconds(pass.seconds),
      Fixed(pass.seconds / floor, 1), pass.samples > 0 ? Significant(pass.samples / 1e6, 3) : "",
      pass.samples > 0 ? Significant(1e9 * pass.seconds / pass.samples, 3) : "" });
  }
  const double floor = FloorOf(result.Bytes(), result.threads, streams);
  table.Add(RowOfTotal("all passes", result, result.SecondsOfPasses(), floor));
  table.Add(RowOfTotal("iteration of the solver", result, result.seconds, floor));
  table.Write(stream);
}

void WriteFloors(std::ostream& stream, const KernelsResults& results)
{
  stream << "\n## A policy iteration and its floor\n\n"
         << "Camera and light at full resolution. Floor: bytes over the fastest stream in memory "
            "with as many threads. Bytes are counted, not measured: every field once for each "
            "pass that reads or writes it, 4 bytes a node, at the nodes that the pass visits; "
            "rays and tables stay in caches and do not count. Samples: rays times layers.\n";
  Table table({ "scene", "threads", "filled", "[MB]", "as for a GPU [MB]", "floor [ms]",
    "measured [ms]", "measured / floor", "spread" });
  for (const FloorResult& result : results.floors)
  {
    const double floor = FloorOf(result.Bytes(), result.threads, results.streams);
    table.Add({ result.scene, std::to_string(result.threads),
      Percent(result.filled / result.voxels), Significant(result.Bytes() / 1e6, 3),
      Significant(result.fieldBytes / 1e6, 3), Milliseconds(floor), Milliseconds(result.seconds),
      Fixed(result.seconds / floor, 1), Percent(result.spread) });
  }
  table.Write(stream);
  stream
    << "Filled: nodes with extinction or importance. As for a GPU: bytes as the page on the GPU "
       "counts them, at every filled node, whether rays come there or not. The passes, "
       "medians:\n";
  for (const FloorResult& result : results.floors)
  {
    WritePasses(stream, result, results.streams);
  }
}

void WriteTimes(std::ostream& stream, const std::vector<KernelTime>& kernels)
{
  stream << "\n## Kernels\n\n"
         << "By Google Benchmark, all in turns, medians. Rows have 256 columns and stay in the "
            "first cache. Bytes: what a kernel reads and writes, each array once.\n";
  Table table({ "kernel", "threads", "call", "item", "[10⁶ items/s]", "[GB/s]", "spread" });
  for (const KernelTime& kernel : kernels)
  {
    const bool isRow = kernel.seconds < 1e-4;
    table.Add({ kernel.name, std::to_string(kernel.threads),
      isRow ? Significant(1e9 * kernel.seconds, 3) + " ns" : Milliseconds(kernel.seconds) + " ms",
      kernel.item, Significant(kernel.itemRate / 1e6, 3), Gigabytes(kernel.byteRate),
      Percent(kernel.spread) });
  }
  table.Write(stream);
}

bool IsNoisy(const KernelsResults& results)
{
  constexpr double most = 0.25;
  return std::any_of(results.floors.begin(), results.floors.end(),
    [](const FloorResult& result) { return result.spread > most; });
}
}

double FloorOf(double bytes, int threads, const std::vector<StreamRate>& streams)
{
  double fastest = 0;
  for (const Stream kind : { Stream::Read, Stream::Copy, Stream::Triad })
  {
    fastest = std::max(fastest, MemoryRate(streams, kind, threads));
  }
  return fastest > 0 ? bytes / fastest : 0;
}

void WriteKernels(std::ostream& stream, const KernelsResults& results)
{
  stream << "\nLoad average at the end: " << Fixed(results.loadAfter, 2)
         << ", this program included.\n";
  if (IsNoisy(results))
  {
    stream << "\n**The machine was busy while this was measured (a spread above 25 %): all times "
              "are preliminary.**\n";
  }
  WriteStreams(stream, results.streams);
  WriteFloors(stream, results);
  WriteTimes(stream, results.kernels);
}
}
