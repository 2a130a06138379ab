// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Counts what ranks that share a scene say to each other, how even their work is, and what memory
// they have for a field, over their share of its nodes: of numbers of ranks, most of any rank. They
// are threads here; what travels is what would travel between machines. Prints JSON.
//   limpid_count_ranks FILE.scene.json RANKS...

#include "HeldByRanks.h"
#include "PlanSweep.h"
#include "SceneForSolver.h"
#include "SilentRanks.h"

#include "optimize/PreparedScene.h"
#include "optimize/Solver.h"
#include "sweep/BandDecomposition.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <numeric>
#include <string>
#include <vector>

using namespace limpid;
using Json = nlohmann::ordered_json;

namespace
{
/// What a rank has sent, and how often it has come to wait.
struct Traffic
{
  std::int64_t messages = 0;
  std::int64_t bytes = 0;
  std::int64_t waits = 0; ///< calls with anything to receive
};

Traffic MostOf(const Traffic& one, const Traffic& other)
{
  return { std::max(one.messages, other.messages), std::max(one.bytes, other.bytes),
    std::max(one.waits, other.waits) };
}

/// Ranks that count.
class CountingRanks : public Communicator
{
public:
  explicit CountingRanks(std::shared_ptr<const Communicator> ranks)
    : Inner(std::move(ranks))
  {
  }

  int Rank() const override { return this->Inner->Rank(); }
  int Size() const override { return this->Inner->Size(); }

  void Exchange(
    const std::vector<Message>& sent, const std::vector<Message>& received) const override
  {
    for (const Message& message : sent)
    {
      this->Sent.bytes += std::int64_t(message.bytes);
    }
    this->Sent.messages += std::int64_t(sent.size());
    this->Sent.waits += received.empty() ? 0 : 1;
    this->Inner->Exchange(sent, received);
  }

  void GiveUp(const std::string& why, bool interrupted) const noexcept override
  {
    this->Inner->GiveUp(why, interrupted);
  }

  Traffic Take() const { return std::exchange(this->Sent, {}); }

private:
  std::shared_ptr<const Communicator> Inner;
  mutable Traffic Sent;
};

/// The unevenness of the sweeps of a source: the work of the busiest rank on a slice over the mean,
/// if all ranks wait for each other on every slice.
double UnevennessOf(const ProblemInOrder& scene, const RaySource& source, int ranks)
{
  const SilentRanks silent(ranks);
  double total = 0;
  double slices = 0;
  for (const PlannedFrustum& frustum :
    PlanSweep(scene.problem.grid, scene.occupancy, source, { scene.problem.settings.rayDensity }))
  {
    const BandDecomposition bands(frustum, silent);
    for (int s = frustum.firstNodeSlice; s <= frustum.lastSlice; ++s)
    {
      const std::vector<Index> work = WorkOfRows(frustum, s);
      Index most = 0;
      for (int rank = 0; rank < ranks; ++rank)
      {
        const Range<int> rays = bands.RaysOf(rank, s);
        most = std::max(
          most, std::accumulate(work.begin() + rays.begin, work.begin() + rays.end, Index(0)));
      }
      total += double(std::accumulate(work.begin(), work.end(), Index(0)));
      slices += double(most);
    }
  }
  return slices * ranks / total;
}

Json CountRanks(const SceneOfFile& scene, const ProblemInOrder& inOrder, int ranks)
{
  std::mutex access;
  std::vector<Traffic> most;
  const Int3 nodes = scene.grid.nodes;
  ThreadRanks::Run(ranks,
    [&](const std::shared_ptr<const Communicator>& all)
    {
      NodeBox box = NodeBox::Of(nodes);
      box.along[2] = { nodes.z * all->Rank() / ranks, nodes.z * (all->Rank() + 1) / ranks };
      const auto counting = std::make_shared<const CountingRanks>(all);
      const Index first = Index(nodes.x) * nodes.y * box.along[2].begin;
      SceneFields fields{ scene.grid, scene.extinction.data() + first,
        scene.importance.data() + first };
      fields.piece = std::make_shared<const ScenePiece>(counting, scene.grid, box);
      Solver solver(fields, scene.camera, scene.light, Settings());
      std::vector<Traffic> traffic{ counting->Take() };
      while (!solver.Step(1))
      {
        traffic.push_back(counting->Take());
      }
      traffic.push_back(counting->Take());
      const std::lock_guard<std::mutex> lock(access);
      most.resize(traffic.size());
      std::transform(most.begin(), most.end(), traffic.begin(), most.begin(), MostOf);
    });
  const double share = double(scene.grid.NodeCount()) / ranks;
  Json result{ { "ranks", ranks }, { "held", double(MostNodesHeld(inOrder, ranks)) / share } };
  for (const Traffic& traffic : most)
  {
    result["steps"].push_back(
      { { "messages", traffic.messages }, { "bytes", traffic.bytes }, { "waits", traffic.waits } });
  }
  result["uneven"] = { { "camera", UnevennessOf(inOrder, inOrder.problem.Camera(), ranks) },
    { "light", UnevennessOf(inOrder, inOrder.problem.Light(), ranks) } };
  return result;
}
}

int main(int argc, char** argv)
{
  if (argc < 3)
  {
    std::fprintf(stderr, "limpid_count_ranks FILE.scene.json RANKS...\n");
    return 2;
  }
  try
  {
    const SceneOfFile scene{ std::string(argv[1]) };
    PreparedScene prepared(scene.Fields());
    const Problem problem = prepared.ProblemFor(scene.camera, scene.light, Settings());
    const ProblemInOrder inOrder(problem);
    Json counted{ { "nodes", { scene.grid.nodes.x, scene.grid.nodes.y, scene.grid.nodes.z } },
      { "filled", problem.occupancy->FilledVoxels() } };
    for (int i = 2; i < argc; ++i)
    {
      counted["counts"].push_back(CountRanks(scene, inOrder, std::stoi(argv[i])));
    }
    std::printf("%s\n", counted.dump(1).c_str());
    return 0;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
