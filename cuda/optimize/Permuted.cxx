// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Permuted.h"

#include "backend/Backend.h"
#include "backend/LargePages.h"
#include "optimize/RestoringMinimizer.h"
#include "sweep/Registers.h"

#include <algorithm>
#include <utility>

namespace limpid
{
namespace
{
/// Returns the grid axis along which rays from a source mainly run.
int DepthAxisOf(const RaySource& source, const Grid& grid)
{
  const Vec3 middle = 0.5 * Vec3(grid.nodes - 1);
  const Vec3 along = glm::abs(source.parallel ? source.direction : middle - source.origin);
  const int xOrY = along.y > along.x ? 1 : 0;
  return along.z >= along[xOrY] ? 2 : xOrY;
}

/// Copies only filled voxels, row by row; both orders have the same rows.
void CopyFilled(const Problem& problem, PermutedFields& fields)
{
  const Grid grid = fields.order.Of(problem.grid);
  const Occupancy& filled = *problem.occupancy;
  const Int3& nodes = grid.nodes;
  const bool exchanged = fields.order.axes[1] == 2;
  OccupancyBuilder builder(grid);
  ParallelFor(nodes.z,
    [&](Index slice)
    {
      const auto z = static_cast<int>(slice);
      for (int y = 0; y < nodes.y; ++y)
      {
        const Range<int> span = (exchanged ? filled.Row(0, z, y) : filled.Row(0, y, z)).filled;
        const Index row = (slice * nodes.y + y) * nodes.x;
        const Index from = (exchanged ? Index(y) * nodes.z + z : slice * nodes.y + y) * nodes.x;
        const auto copy = [&](const float* values, NodeValues& permuted)
        {
          std::copy(values + from + span.begin, values + from + std::max(span.begin, span.end),
            permuted.Data() + row + span.begin);
        };
        copy(problem.baseExtinction, fields.base);
        copy(problem.importance, fields.importance);
        copy(problem.nodeImportance, fields.nodeImportance);
        const bool needed =
          !span.Empty() || y == 0 || y + 1 == nodes.y; // first and last rows are always written
        if (needed)
        {
          builder.Add(
            z, { y, y + 1 }, fields.base.Data() + row, fields.nodeImportance.Data() + row);
        }
      }
    });
  fields.occupancy = std::make_shared<const Occupancy>(builder.Take(filled.Skips()));
}

std::shared_ptr<const PermutedFields> MakeFields(
  const Problem& problem, const AxisPermutation& order)
{
  auto fields = std::make_shared<PermutedFields>();
  fields->order = order;
  for (NodeValues* values : { &fields->base, &fields->importance, &fields->nodeImportance })
  {
    *values = NodeValues(problem.grid.NodeCount());
  }
  if (order.axes[0] == 0)
  {
    CopyFilled(problem, *fields);
    return fields;
  }
  Permute(problem.grid, order, problem.baseExtinction, fields->base.Data());
  Permute(problem.grid, order, problem.importance, fields->importance.Data());
  Permute(problem.grid, order, problem.nodeImportance, fields->nodeImportance.Data());
  fields->occupancy = std::make_shared<const Occupancy>(order.Of(problem.grid), fields->base.Data(),
    fields->nodeImportance.Data(), problem.occupancy->Skips());
  return fields;
}

/// Returns the fields in an order, reusing those of the previous problem if possible.
std::shared_ptr<const PermutedFields> FieldsFor(
  const Problem& problem, const AxisPermutation& order)
{
  if (!problem.resident)
  {
    return MakeFields(problem, order);
  }
  const std::lock_guard<std::mutex> lock(problem.resident->access);
  std::shared_ptr<const PermutedFields>& kept = problem.resident->permuted;
  const bool fits = kept && kept->order.axes == order.axes &&
    kept->occupancy->Skips() == problem.occupancy->Skips();
  if (!fits)
  {
    kept.reset();
    kept = MakeFields(problem, order);
  }
  return kept;
}

class PermutedMinimizer : public RestoringMinimizer
{
public:
  PermutedMinimizer(const Problem& problem, const AxisPermutation& order)
    : Nodes(problem.grid)
    , Fields(FieldsFor(problem, order))
    , Inside(Reordered(problem, order))
  {
    this->Inside.baseExtinction = this->Fields->base.Data();
    this->Inside.importance = this->Fields->importance.Data();
    this->Inside.nodeImportance = this->Fields->nodeImportance.Data();
    this->Inside.occupancy = this->Fields->occupancy;
    this->Inside.derived = {};
    for (Pull& pull : this->Inside.furtherPulls)
    {
      this->References.push_back(this->Room());
      Permute(this->Nodes, order, pull.reference, this->References.back().data());
      pull.reference = this->References.back().data();
    }
  }

  const Problem& ProblemInside() const { return this->Inside; }
  bool HasOwnFields() const override { return true; }

  /// Permutes a starting extinction. `start`: in the order of the problem.
  StartingExtinction InOrder(const StartingExtinction& start) const
  {
    StartingExtinction first;
    if (start)
    {
      first = this->Room();
      Permute(this->Nodes, this->Fields->order, start->data(), first->data());
    }
    return first;
  }

private:
  std::vector<float> Room() const
  {
    std::vector<float> values = RoomFor(this->Nodes.NodeCount());
    values.resize(std::size_t(this->Nodes.NodeCount()));
    return values;
  }

  void Restore(const Minimizer& inner, std::vector<float>& best) const override
  {
    if (best.empty())
    {
      best = this->Room();
    }
    PermuteBack(this->Nodes, this->Fields->order, inner.BestValues(), best.data());
  }

  Grid Nodes; ///< of the original problem
  std::shared_ptr<const PermutedFields> Fields;
  Problem Inside;                             ///< the permuted problem
  std::vector<std::vector<float>> References; ///< of its further pulls
};
}

Problem Reordered(const Problem& problem, const AxisPermutation& order)
{
  Problem reordered = problem;
  reordered.grid = order.Of(problem.grid);
  for (TermSource& source : reordered.sources)
  {
    source.rays = order.Of(source.rays);
  }
  reordered.resident = nullptr; // cached data are in the original order
  return reordered;
}

AxisPermutation OrderFor(const Problem& problem)
{
  if (problem.isMeasuredOnly)
  {
    return {};
  }
  const Weights& weights = problem.settings.weights;
  const int camera = DepthAxisOf(problem.Camera(), problem.grid);
  const int light = DepthAxisOf(problem.Light(), problem.grid);
  const int last = weights.view > 0 ? camera : light;
  const int avoided = weights.light > 0 ? light : last;
  int first = 0;
  while (first == last || first == avoided)
  {
    ++first;
  }
  // Rows of a few voxels take nearly as long as rows that fill a register.
  const int second = 3 - first - last;
  const Int3& nodes = problem.grid.nodes;
  const bool exchanged =
    second != avoided && nodes[first] < registerLanes && nodes[second] > nodes[first];
  return { exchanged ? Int3(second, first, last) : Int3(first, second, last) };
}

std::unique_ptr<Minimizer> MakePermuted(const Problem& problem, const AxisPermutation& order,
  StartingExtinction&& start,
  const std::function<std::unique_ptr<Minimizer>(const Problem&, StartingExtinction&&)>& make)
{
  if (!order.Changes())
  {
    return make(problem, std::move(start));
  }
  auto minimizer = std::make_unique<PermutedMinimizer>(problem, order);
  minimizer->Use(make(minimizer->ProblemInside(), minimizer->InOrder(std::exchange(start, {}))));
  return minimizer;
}
}
