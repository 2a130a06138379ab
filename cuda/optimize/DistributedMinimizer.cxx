// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/DistributedMinimizer.h"

#include "backend/Interruption.h"
#include "backend/LargePages.h"
#include "distributed/DistributedFields.h"
#include "distributed/ExchangePlan.h"
#include "distributed/Neighbourhood.h"
#include "distributed/OccupancyOnRanks.h"
#include "energy/NodeTransmittance.h"
#include "energy/TransmittanceSweep.h"
#include "energy/VisibilityTerm.h"
#include "optimize/Permuted.h"
#include "optimize/RestoringMinimizer.h"
#include "optimize/SolverBackend.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

namespace limpid
{
namespace
{
NodeBox InOrder(const NodeBox& box, const AxisPermutation& order)
{
  NodeBox permuted;
  for (int axis = 0; axis < 3; ++axis)
  {
    permuted.along[std::size_t(axis)] = box.along[std::size_t(order.axes[axis])];
  }
  return permuted;
}

FieldView InOrder(const FieldView& view, const AxisPermutation& order)
{
  FieldView permuted{ view.values, {} };
  for (int axis = 0; axis < 3; ++axis)
  {
    permuted.stride[std::size_t(axis)] = view.stride[std::size_t(order.axes[axis])];
  }
  return permuted;
}

std::vector<NodeBox> InOrder(std::vector<NodeBox> boxes, const AxisPermutation& order)
{
  for (NodeBox& box : boxes)
  {
    box = InOrder(box, order);
  }
  return boxes;
}

/// View of a field in this rank's subdomain, with permuted axes.
FieldView PieceOf(const Problem& problem, const AxisPermutation& order, const float* field)
{
  return InOrder(FieldView::Part(const_cast<float*>(field), problem.piece->nodes), order);
}

std::shared_ptr<const Occupancy> FindOccupancy(const ScenePiece& piece, const Grid& grid,
  const AxisPermutation& order, const FieldView& extinction, const FieldView& importance, bool skip)
{
  const NodeBox box = InOrder(piece.owned[std::size_t(piece.ranks->Rank())], order);
  return std::make_shared<const Occupancy>(
    OccupancyOnRanks(*piece.ranks, order.Of(grid), box, extinction, importance, skip));
}

/// Returns the permuted problem with distributed fields. `warm`: whether iterations start from a
/// given extinction.
Problem Shared(const Problem& problem, const AxisPermutation& order, bool warm)
{
  const ScenePiece& piece = *problem.piece;
  const auto fields = std::make_shared<DistributedFields>();
  fields->ranks = piece.ranks;
  fields->pieces = RegionsOf(InOrder(piece.owned, order));
  fields->wanted = RegionsOf(InOrder(piece.boxes, order));
  fields->places = piece.places;
  const Settings& settings = problem.settings;
  fields->inSlabs = warm || !problem.furtherPulls.empty() || problem.IsThick() ||
    settings.solver == SolverKind::Adam || settings.smoothness > 0;
  const auto fieldOf = [&](const float* values)
  {
    return DistributedFields::Field{ PieceOf(problem, order, values),
      NodeValues(problem.grid.NodeCount()) };
  };
  fields->base = fieldOf(problem.baseExtinction);
  fields->importance = fieldOf(problem.importance);
  fields->nodeImportance = fieldOf(problem.nodeImportance);
  for (const Pull& pull : problem.furtherPulls)
  {
    fields->references.push_back(fieldOf(pull.reference));
  }

  Problem shared = Reordered(problem, order);
  shared.Use(fields);
  shared.occupancy = FindOccupancy(piece, problem.grid, order, fields->base.piece,
    fields->nodeImportance.piece, problem.settings.skipUnneeded);
  shared.piece = nullptr;
  return shared;
}

void Add(const Vec3& vector, std::vector<double>& numbers)
{
  numbers.insert(numbers.end(), { vector.x, vector.y, vector.z });
}

void Add(const Camera& camera, std::vector<double>& numbers)
{
  for (const Vec3& vector : { camera.position, camera.focalPoint, camera.viewUp })
  {
    Add(vector, numbers);
  }
  numbers.insert(numbers.end(),
    { camera.viewAngle, double(camera.parallel), camera.parallelScale, camera.aspect,
      double(camera.corners.size()) });
}

/// Whether all ranks have the same numbers.
bool AreAlike(const Communicator& ranks, const std::vector<double>& numbers)
{
  // Numbers are equal if their minimum equals their maximum: minima of each word w and of -1 - w.
  std::vector<std::int32_t> words(2 * numbers.size());
  std::memcpy(words.data(), numbers.data(), words.size() * sizeof(std::int32_t));
  std::vector<std::int32_t> both = words;
  std::transform(words.begin(), words.end(), std::back_inserter(both),
    [](std::int32_t word) { return -1 - word; });
  ranks.TakeLeast(both.data(), both.size());
  bool alike = true;
  for (std::size_t i = 0; i < words.size(); ++i)
  {
    alike = alike && both[i] == -1 - both[words.size() + i];
  }
  return alike;
}

class DistributedMinimizer : public RestoringMinimizer
{
public:
  DistributedMinimizer(const Problem& problem, const AxisPermutation& order, bool warm)
    : Given(&problem)
    , Order(order)
    , Inside(Shared(problem, order, warm))
  {
  }

  const Problem& ProblemInside() const { return this->Inside; }

  /// `start`: in this rank's subdomain.
  StartingExtinction InSlab(const StartingExtinction& start) const
  {
    if (!start)
    {
      return {};
    }
    const DistributedFields& fields = *this->Inside.shared;
    const Slab own = this->Inside.OwnSlab();
    std::vector<float> values(std::size_t(own.Count()));
    Spread(*fields.ranks, PieceOf(*this->Given, this->Order, start->data()), fields.pieces,
      FieldView::Part(values.data(), own.Box()),
      RegionsOf(EvenSlabs(*fields.ranks, this->Inside.grid.nodes)));
    return values;
  }

  IterationRecord Start() override
  {
    const SmallPages small;
    return RestoringMinimizer::Start();
  }

  IterationRecord Iterate() override
  {
    const SmallPages small;
    return RestoringMinimizer::Iterate();
  }

  IterationRecord Smooth() override
  {
    const SmallPages small;
    return RestoringMinimizer::Smooth();
  }

private:
  void Restore(const Minimizer& inner, std::vector<float>& best) const override
  {
    // Voxels that no sweep reaches keep the base extinction.
    const float* base = this->Given->baseExtinction;
    best.assign(base, base + this->Given->piece->nodes.Count());
    inner.BestToPiece(PieceOf(*this->Given, this->Order, best.data()));
  }

  const Problem* Given;
  AxisPermutation Order;
  Problem Inside; ///< the permuted problem
};

/// Makes sweeps use the fields of the ranks' subdomains. `filled`: see FieldSlabs.
void VisitPieces(
  std::vector<FrustumRays<HostDevice>>& frusta, const ScenePiece& piece, const Occupancy* filled)
{
  const FieldLayout home(piece.nodes, RegionsOf(piece.owned), RegionsOf(piece.boxes));
  const auto room = std::make_shared<ExchangeBuffers>();
  for (FrustumRays<HostDevice>& rays : frusta)
  {
    rays.SweepFieldsOf(home, filled, room);
  }
}

class SweepsOnRanks : public SourceSweeps
{
public:
  SweepsOnRanks(const Problem& problem, const RaySource& source)
    : Given(&problem)
    , Occupied(FindOccupancy(*problem.piece, problem.grid, AxisPermutation(),
        PieceOf(problem, AxisPermutation(), problem.baseExtinction),
        PieceOf(problem, AxisPermutation(), problem.nodeImportance), problem.settings.skipUnneeded))
    , Term(HostDevice::Shared(), problem.grid, *this->Occupied, source, problem.settings.rayDensity,
        *problem.piece->ranks, problem.fine)
  {
    VisitPieces(this->Term.Frusta(), *problem.piece, this->Occupied.get());
  }

  Score ScoreOf(const float* extinction) override
  {
    const SmallPages small;
    const float* base = There(this->Given->baseExtinction);
    if (!this->Base)
    {
      this->Base = this->See(base, nullptr).all;
    }
    // A rank with an empty subdomain cannot tell whether this is the base extinction.
    if (!this->Given->piece->ranks->AnyOf(extinction != this->Given->baseExtinction))
    {
      return ScoreOfBase(*this->Base);
    }
    return limpid::ScoreOf(this->See(There(extinction), base), this->Base->unattenuated);
  }

  Ceiling CeilingOf(const float* least, const MostExtinction<float>& most) override
  {
    const SmallPages small;
    const CeilingFields fields{ There(this->Given->baseExtinction), There(this->Given->importance),
      least ? There(least) : nullptr, most };
    Seen seen;
    this->Term.FindCeiling(fields, &seen);
    return limpid::CeilingOf(seen, fields.CountsKept());
  }

  void SweepPolicyOnce(double, std::vector<float>&) override
  {
    throw JointError(
      "A preview was requested in a distributed run (this is not supported). Use Solver.");
  }

private:
  /// `base`: null if kept base extinction is not counted.
  Seen See(const float* extinction, const float* base)
  {
    Seen seen;
    this->Term.Forward({ extinction, There(this->Given->importance), nullptr, base }, &seen);
    return seen;
  }

  const Problem* Given;
  std::shared_ptr<const Occupancy> Occupied;
  VisibilityTerm<HostDevice> Term;
  std::optional<Visible> Base; ///< empty before the first sweep
};

NodesWithin Within(const NodeBox& box)
{
  const auto& along = box.along;
  return box.Empty() ? NodesWithin{ Int3(0), Int3(0) }
                     : NodesWithin{ { along[0].begin, along[1].begin, along[2].begin },
                         { along[0].end, along[1].end, along[2].end } };
}

/// The cells of a rank: those whose first owned corner belongs to it.
struct CellsOfRank
{
  std::vector<NodesWithin> owned; ///< [rank]: owned nodes
  NodesWithin own;
  Int3 last; ///< last node of the grid
  std::size_t rank;

  CellsOfRank(const ScenePiece& piece, const Grid& grid)
    : last(grid.nodes - 1)
    , rank(std::size_t(piece.ranks->Rank()))
  {
    for (const NodeBox& box : piece.owned)
    {
      this->owned.push_back(Within(box));
    }
    this->own = this->owned[this->rank];
  }

  /// Returns the range of the first nodes of all cells that may belong to this rank.
  NodesWithin Near() const
  {
    return { glm::max(this->own.begin - 1, Int3(0)), glm::min(this->own.end, this->last) };
  }

  bool operator()(const Int3& cell) const
  {
    for (int corner = 0; corner < 8; ++corner)
    {
      const Int3 node = cell + Int3(corner & 1, corner >> 1 & 1, corner >> 2);
      if (this->own.Contains(node))
      {
        return true;
      }
      if (std::any_of(this->owned.begin(), this->owned.end(),
            [&](const NodesWithin& box) { return box.Contains(node); }))
      {
        return false;
      }
    }
    return false;
  }
};

/// A field of a subdomain, extended by ghost values from the owners.
struct WiderField
{
  FieldInBox values;
  FieldWithin nodes;

  WiderField(const ScenePiece& piece, const ScenePiece& wider, const float* field)
    : values(FieldIn(piece, wider.boxes, There(field)))
    , nodes{ this->values.Data(), Within(wider.nodes) }
  {
  }
};

/// Returns the nodes of a rank around which transmittance is steep.
std::vector<Int3> SteepNodes(
  const NodesWithin& own, const FieldWithin& transmittance, const NodeRays& rays)
{
  std::vector<Int3> steep;
  for (int k = own.begin.z; k < own.end.z; ++k)
  {
    Interruptible::Check();
    for (int j = own.begin.y; j < own.end.y; ++j)
    {
      for (int i = own.begin.x; i < own.end.x; ++i)
      {
        const Int3 node(i, j, k);
        if (transmittance.IsSteepAt(node) && rays.See(node))
        {
          steep.push_back(node);
        }
      }
    }
  }
  return steep;
}

/// Nodes of all ranks, gathered on every rank.
struct NodesOfRanks
{
  std::vector<std::int64_t> coordinates; ///< three per node
  std::size_t first = 0;                 ///< index of this rank's first node

  NodesOfRanks(const Communicator& ranks, const Int3* nodes, std::size_t count)
  {
    std::vector<std::int64_t> counts(std::size_t(ranks.Size()));
    const auto own = counts.begin() + ranks.Rank();
    *own = static_cast<std::int64_t>(count);
    ranks.Sum(counts.data(), counts.size());
    this->first = std::size_t(std::accumulate(counts.begin(), own, std::int64_t(0)));
    this->coordinates.resize(
      3 * std::size_t(std::accumulate(counts.begin(), counts.end(), std::int64_t(0))));
    for (std::size_t i = 0; i < 3 * count; ++i)
    {
      this->coordinates[3 * this->first + i] = nodes[i / 3][int(i % 3)];
    }
    ranks.Sum(this->coordinates.data(), this->coordinates.size());
  }

  std::size_t Count() const { return this->coordinates.size() / 3; }
  Int3 operator[](std::size_t i) const
  {
    const std::int64_t* node = this->coordinates.data() + 3 * i;
    return { int(node[0]), int(node[1]), int(node[2]) };
  }
};
}

void RequireAlike(const Communicator& ranks, const Grid& grid, const Camera& camera,
  const Light& light, const Settings& settings, double nearness)
{
  std::vector<double> numbers;
  for (int axis = 0; axis < 3; ++axis)
  {
    numbers.insert(
      numbers.end(), { double(grid.nodes[axis]), grid.origin[axis], grid.spacing[axis] });
    Add(grid.direction[axis], numbers);
  }
  Add(camera, numbers);
  for (const Camera& other : settings.otherCameras)
  {
    Add(other, numbers);
  }
  numbers.push_back(double(light.type));
  Add(light.position, numbers);
  Add(light.focalPoint, numbers);
  Settings compared = settings;
  compared.backend = BackendKind::Cpu; // of ranks, whatever each of them says
  const std::vector<double> values = NumbersOf(compared);
  numbers.insert(numbers.end(), values.begin(), values.end());
  numbers.push_back(nearness);
  if (!AreAlike(ranks, { double(numbers.size()) }) || !AreAlike(ranks, numbers))
  {
    throw JointError(
      "The ranks differ in the camera, the light, the settings or the position of the image "
      "(distributed runs need these to be equal). Give all ranks the same.");
  }
}

std::unique_ptr<SourceSweeps> SweepsFromOnRanks(const Problem& problem, const RaySource& source)
{
  const SmallPages small;
  return std::make_unique<SweepsOnRanks>(problem, source);
}

void FindTransmittanceOnRanks(const Grid& grid, const ScenePiece& piece, const RaySource& source,
  double rayDensity, const float* extinction, float* transmittance)
{
  const SmallPages small;
  const FieldView given = FieldView::Part(const_cast<float*>(extinction), piece.nodes);
  const auto occupancy = FindOccupancy(piece, grid, AxisPermutation(), given, given, /*skip=*/true);
  TransmittanceSweep<HostDevice> sweep(
    HostDevice::Shared(), grid, *occupancy, source, rayDensity, *piece.ranks);
  VisitPieces(sweep.Frusta(), piece, nullptr);
  std::fill(transmittance, transmittance + piece.nodes.Count(), 1.0f); // for nodes that no ray
                                                                       // reaches
  sweep.Sweep(There(extinction), There(transmittance));
}

void RefineTransmittanceOnRanks(const Grid& grid, const ScenePiece& piece, const RaySource& source,
  const float* extinction, float* transmittance)
{
  constexpr std::size_t nodesAtATime = 1 << 18; // per rank
  const Communicator& ranks = *piece.ranks;
  const NodeRays rays(grid, source);
  const CellsOfRank cells(piece, grid);
  const auto wider = Grown(piece, grid, 1);
  const WiderField absorbing(piece, *wider, extinction);
  const std::vector<Int3> steep =
    SteepNodes(cells.own, WiderField(piece, *wider, transmittance).nodes, rays);
  const FieldView result = FieldView::Part(There(transmittance), piece.nodes);
  for (std::size_t done = 0; ranks.AnyOf(done < steep.size()); done += nodesAtATime)
  {
    const std::size_t begin = std::min(done, steep.size());
    const std::size_t count = std::min(steep.size() - begin, nodesAtATime);
    const NodesOfRanks nodes(ranks, steep.data() + begin, count);
    std::vector<WholeDepth> depths(nodes.Count());
    ParallelFor(Index(depths.size()), 64,
      [&](Index i)
      {
        depths[std::size_t(i)] =
          rays.DepthTo(nodes[std::size_t(i)], absorbing.nodes, cells.Near(), cells);
      });
    ranks.Sum(depths.data(), depths.size());
    for (std::size_t i = 0; i < count; ++i)
    {
      const Int3& node = steep[begin + i];
      result.values[result.At(node.x, node.y, node.z)] = TransmittanceOf(depths[nodes.first + i]);
    }
  }
  Spread(ranks, result, RegionsOf(piece.owned), result, RegionsOf(piece.boxes));
}

std::unique_ptr<Minimizer> MakeDistributed(const Problem& problem, const StartingExtinction& start,
  const std::function<std::unique_ptr<Minimizer>(const Problem&, StartingExtinction&&)>& make)
{
  const SmallPages small;
  auto minimizer =
    std::make_unique<DistributedMinimizer>(problem, OrderFor(problem), start.has_value());
  minimizer->Use(make(minimizer->ProblemInside(), minimizer->InSlab(start)));
  return minimizer;
}
}
