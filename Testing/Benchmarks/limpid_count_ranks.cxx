// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Counts what ranks that share a scene say to each other, how even their work is, and what they
// need of the fields: of numbers of ranks, most of any rank. They are threads here; what travels is
// what would travel between machines. Prints JSON.
//   limpid_count_ranks FILE.scene.json RANKS...

#include "SceneForSolver.h"
#include "SilentRanks.h"
#include "ThreadRanks.h"

#include "optimize/Permuted.h"
#include "optimize/PreparedScene.h"
#include "optimize/Solver.h"
#include "sweep/PlanSweep.h"
#include "sweep/RankBands.h"
#include "sweep/RankRegions.h"

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

/// A problem in the order of axes in which it is swept.
struct InOrder
{
  Problem problem;
  Occupancy occupancy;

  explicit InOrder(const Problem& given)
    : problem(Reordered(given, OrderFor(given)))
    , occupancy(OccupancyOf(given))
  {
  }

  static Occupancy OccupancyOf(const Problem& given)
  {
    const AxisPermutation order = OrderFor(given);
    std::vector<float> base(std::size_t(given.grid.NodeCount()));
    std::vector<float> importance(base.size());
    Permute(given.grid, order, given.baseExtinction, base.data());
    Permute(given.grid, order, given.nodeImportance, importance.data());
    return { order.Of(given.grid), base.data(), importance.data(), given.settings.skipUnneeded };
  }
};

/// Of the sweeps of a source: work of the rank that has most on a slice, over the mean, where all
/// wait for each other on every slice.
double UnevennessOf(const InOrder& scene, const RaySource& source, int ranks)
{
  const SilentRanks silent(ranks);
  double total = 0;
  double slices = 0;
  for (const PlannedFrustum& frustum :
    PlanSweep(scene.problem.grid, scene.occupancy, source, { scene.problem.settings.rayDensity }))
  {
    const RankBands bands(frustum, silent);
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

/// Filled nodes that the rank needs that needs most, for all sweeps.
Index MostNeeded(const InOrder& scene, const std::vector<PlannedFrustum>& frusta, int ranks)
{
  const Int3 nodes = scene.problem.grid.nodes;
  const SilentRanks silent(ranks);
  std::vector<RankBands> bands;
  bands.reserve(frusta.size());
  for (const PlannedFrustum& frustum : frusta)
  {
    bands.emplace_back(frustum, silent);
  }
  Index most = 0;
  for (int rank = 0; rank < ranks; ++rank)
  {
    std::vector<char> needed(std::size_t(scene.problem.grid.NodeCount()), 0);
    for (std::size_t i = 0; i < frusta.size(); ++i)
    {
      for (const NodeBox& box : RegionNeeded(frusta[i], bands[i], rank))
      {
        ForRowsOf(box, &scene.occupancy,
          [&](const Int3& first, int count)
          {
            const Index at = (Index(first.z) * nodes.y + first.y) * nodes.x + first.x;
            std::fill_n(needed.begin() + at, count, char(1));
          });
      }
    }
    most = std::max(most, std::accumulate(needed.begin(), needed.end(), Index(0)));
  }
  return most;
}

/// That over a rank's share of what one process needs.
double NeedOf(const InOrder& scene, int ranks)
{
  std::vector<PlannedFrustum> frusta;
  for (const RaySource* source : { &scene.problem.camera, &scene.problem.light })
  {
    for (PlannedFrustum& frustum : PlanSweep(
           scene.problem.grid, scene.occupancy, *source, { scene.problem.settings.rayDensity }))
    {
      frusta.push_back(std::move(frustum));
    }
  }
  return double(MostNeeded(scene, frusta, ranks)) * ranks / double(MostNeeded(scene, frusta, 1));
}

Json CountRanks(const SceneOfFile& scene, const InOrder& inOrder, int ranks)
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
  Json result{ { "ranks", ranks }, { "needed", NeedOf(inOrder, ranks) } };
  for (const Traffic& traffic : most)
  {
    result["steps"].push_back(
      { { "messages", traffic.messages }, { "bytes", traffic.bytes }, { "waits", traffic.waits } });
  }
  for (const auto& [name, source] : { std::pair{ "camera", &inOrder.problem.camera },
         std::pair{ "light", &inOrder.problem.light } })
  {
    result[name] = { { "slices", UnevennessOf(inOrder, *source, ranks) } };
  }
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
    const InOrder inOrder(problem);
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
