// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Optimises the head of vtkOcclusionPhantom at resolutions of which the largest would not fit into
// memory if each of its fields had a value per node there. Nothing is written where nothing is, and
// small pages that nobody writes take no memory. Prints a page in Markdown.
//   limpid_large NODES...

#include "PeakMemory.h"
#include "Program.h"

#include "PhantomScenes.h"
#include "Today.h"

#include "backend/Backend.h"
#include "backend/HostDevice.h"
#include "backend/LargePages.h"
#include "optimize/Permuted.h"
#include "optimize/Policy.h"
#include "optimize/PreparedScene.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

using namespace limpid;

namespace
{
constexpr double fields = 7; ///< of the optimiser

/// The phantom with its y last: the camera looks along that axis, so that no field has to be copied
/// into another order.
struct Head
{
  Grid grid;
  NodeValues extinction;
  NodeValues importance;
  Camera camera;
  Light light;

  explicit Head(int nodes)
  {
    const double spacing = 2.0 / (nodes - 1);
    this->grid.nodes = Int3(nodes);
    this->grid.origin = Vec3(-1);
    this->grid.spacing = Vec3(spacing);
    this->extinction = NodeValues(this->grid.NodeCount());
    this->importance = NodeValues(this->grid.NodeCount());
    const double edge = PhantomEdge(spacing);
    ParallelFor(Index(nodes) * nodes,
      [&](Index row)
      {
        const Index slice = row / nodes;
        const double y = double(slice) * spacing - 1;
        const double z = double(row % nodes) * spacing - 1;
        std::vector<float> extinctions;
        std::vector<float> importances;
        for (int i = 0; i < nodes; ++i)
        {
          const Material material = HeadScene({ i * spacing - 1, y, z }, edge);
          extinctions.push_back(float(material.extinction));
          importances.push_back(float(material.importance));
        }
        WriteRow(extinctions, row, this->extinction);
        WriteRow(importances, row, this->importance);
      });
    this->camera.position = Vec3(1.9, 1.5, -4.7);
    this->camera.viewUp = Vec3(0, 1, 0);
    this->light.position = Vec3(-2.5, 4.5, -4.5);
  }

private:
  static void WriteRow(const std::vector<float>& values, Index row, NodeValues& field)
  {
    const auto isZero = [](float value) { return value == 0; };
    if (!std::all_of(values.begin(), values.end(), isZero))
    {
      std::copy(values.begin(), values.end(), field.Data() + row * Index(values.size()));
    }
  }
};

const char* const page =
  R"(The core optimises the head of `vtkOcclusionPhantom` in one process (`Testing/Benchmarks/limpid_large.cxx`):

    build/bin/limpid_large 128 256 512 1024 > Documentation/Benchmarks/LargeVolumes.md

The optimiser has seven fields: base extinction, importance, the importance of nodes, three iterates and the
derivative of the light's term. None of them is written where the scene is empty. With small pages, memory that
is not written is not allocated. *Peak* is the largest resident memory, *scene* the part of the scene in it, and *dense*
the memory of seven fields with a value per node. In the phantom, *peak* is little more than half of *dense*. MPI processes
divide it ([Ranks.md](Ranks.md)). Images of VTK, whose arrays are dense, are not included.

S and the visible share of the important structures must converge, because edges of the phantom are as wide as the
distance of its nodes. The policy has default settings and runs from the base to its end. Times are medians of iterations
and sums.
)"
  "\n| nodes | filled | S, base | S, optimised | visible | iterations | iteration [s] | "
  "all [s] | scene [GB] | peak [GB] | dense [GB] |\n"
  "| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |";

double SecondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void Report(int nodes)
{
  const SmallPages small;
  const benchmark::PeakMemory memory;
  const Head head(nodes);
  const double ofScene = memory.Bytes();
  const auto begin = std::chrono::steady_clock::now();
  PreparedScene prepared({ head.grid, head.extinction.Data(), head.importance.Data() });
  const Problem problem = prepared.ProblemFor(head.camera, head.light, Settings());
  LIMPID_REQUIRE(!OrderFor(problem).Changes(), "The scene is not in the order of sweeps.");
  const auto policy = MakePolicy(HostDevice::Shared(), problem, {}, false);
  IterationRecord best = policy->Start();
  const Score base = policy->BaseScore();
  std::vector<double> seconds;
  while (!policy->Converged() && int(seconds.size()) < policy->IterationLimit())
  {
    const auto start = std::chrono::steady_clock::now();
    const IterationRecord record = policy->Iterate();
    seconds.push_back(SecondsSince(start));
    best = record.energy.Total() < best.energy.Total() ? record : best;
  }
  const double all = SecondsSince(begin);
  std::nth_element(
    seconds.begin(), seconds.begin() + std::ptrdiff_t(seconds.size() / 2), seconds.end());
  const auto count = double(head.grid.NodeCount());
  std::printf("| %d^3 | %.1f %% | %.4f | %.4f | %.3f | %zu | %.2f | %.1f | %.2f | %.2f | %.1f |\n",
    nodes, 100 * double(problem.occupancy->FilledVoxels()) / count, base.visibility,
    best.score.visibility, best.score.fraction, seconds.size(), seconds[seconds.size() / 2], all,
    ofScene / 1e9, memory.Bytes() / 1e9, fields * sizeof(float) * 1e-9 * count);
  std::fflush(stdout);
}
}

int main(int argumentCount, char** arguments)
{
  std::printf("# Large volumes\n\n* date: %s\n* load average before the start: %.2f\n\n%s\n",
    Today().c_str(), benchmark::LoadAverage(), page);
  try
  {
    for (int i = 1; i < argumentCount; ++i)
    {
      Report(std::atoi(arguments[i]));
    }
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
